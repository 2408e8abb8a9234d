// Rows of the lights: light.count, and light.<i>.* for i below 16.
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/rows.h"
#include "renderer/settings/sources.h"
#include "renderer/settings/splits.h"

namespace si {
namespace {

using namespace rows;

constexpr Choice kTypes[] = {
    {"directional", "directional", "Parallel rays from infinitely far away, as the sun's."},
    {"spot", "spot", "A cone from a point; falls with the square of the distance."},
    {"point", "point", "All directions from a point, drawn as six map faces; falls with the square of the distance."},
};
constexpr Choice kProjections[] = {
    {"auto", "automatic", "Orthographic for directional lights, perspective for the others."},
    {"orthographic", "orthographic", "Parallel rays in the map."},
    {"perspective", "perspective", "Rays from the light's place; on a directional light wrong on purpose, to compare."},
};

constexpr Choice kNearFar[] = {
    {"fitted", "by the fit", "Casters and receivers in the fit's region; with a manual fit light.near and light.far."},
    {"manual", "by hand", "light.near and light.far, whatever the fit; 0 is the fit's value."},
    {"casters", "first caster to last receiver",
     "From the first caster to the last receiver between the map's sides. Everything before the first caster is lit."},
    {"scene", "whole scene", "From the first to the last object of the scene, also beyond the map's sides."},
    {"pancaking", "first to last receiver",
     "From the first receiver, with room for the bias. Casters before it are drawn flat on the near plane (pancaking). "
     "Depth steps are the finest. The distance from caster to receiver is lost, so penumbrae that depend on it "
     "(PCSS) are too narrow."},
};

constexpr Choice kDepthBounds[] = {
    {"boxes", "bounding boxes", "Depths of the receivers' boxes in the view frustum, known before anything is drawn."},
    {"sdsm", "depth buffer (SDSM)",
     "The smallest and largest depth in the camera's depth buffer, which is drawn and read back first: sample "
     "distribution shadow maps (Lauritzen, Salvi, Lefohn, I3D 2011)."},
};

constexpr Choice kCascadeChoices[] = {
    {"interval", "by depth", "By the camera depth of the point."},
    {"map", "by map",
     "The finest map that contains the point, often finer than the map of its interval. The blend band is then at the "
     "map's rim."},
};

const LightSettings& of(const Settings& s, int i) {
    return s.lights[std::size_t(i)];
}
bool has_type(const Settings& s, int i, LightType type) {
    return of(s, i).type == type;
}
bool is_orthographic(const Settings& s, int i) {
    if (has_type(s, i, LightType::Point)) return false;
    const LightProjection projection = of(s, i).projection;
    return projection == LightProjection::Orthographic ||
           (projection == LightProjection::Automatic && has_type(s, i, LightType::Directional));
}

/// Returns the reason why the region of the light's map has no effect: no map is drawn, and the camera does not look
/// through the light. Empty if it has an effect.
std::string_view map_idle(const Settings& s, int i) {
    if (s.camera.source == CameraSource::Light && s.view.light == i) return "";
    if (!of(s, i).cast) return "without effect: the light casts no shadow";
    return source_of(s, i).needs.map ? "" : "without effect: light.source is not a map";
}

/// Returns the reason why light.fit has no effect.
std::string_view fit_idle(const Settings& s, int i) {
    if (const auto reason = map_idle(s, i); !reason.empty()) return reason;
    // Its depth range is then by hand.
    const bool manual = of(s, i).fit == LightFit::Manual;
    return has_type(s, i, LightType::Point) && !manual ? "without effect: a point light's six faces look everywhere"
                                                       : "";
}

std::string_view planes_idle(const Settings& s, int i) {
    if (const auto reason = map_idle(s, i); !reason.empty()) return reason;
    if (fit_row(of(s, i).fit).warps && has_type(s, i, LightType::Directional) && is_orthographic(s, i) &&
        s.camera.source != CameraSource::Light)
        return "without effect: a warped map's depths are fitted";
    return uses_manual_near_far(of(s, i)) ? "" : "without effect: set light.near_far to manual to choose it by hand";
}

std::string_view extent_idle(const Settings& s, int i) {
    if (const auto reason = map_idle(s, i); !reason.empty()) return reason;
    if (of(s, i).fit != LightFit::Manual) return "without effect: set light.fit to manual to choose it by hand";
    return is_orthographic(s, i) || has_type(s, i, LightType::Spot)
               ? ""
               : "without effect: only an orthographic map and a spot light's have an extent";
}

std::string_view projection_idle(const Settings& s, int i) {
    if (const auto reason = map_idle(s, i); !reason.empty()) return reason;
    return has_type(s, i, LightType::Point) ? "without effect: a point light has six perspective faces" : "";
}

std::string_view size_idle(const Settings& s, int i) {
    // Several rays of a texel end all over the light; a single one ends at its middle.
    const bool baked = of(s, i).cast && source_of(s, i).needs.light_map && s.light_map.samples > 1;
    return s.truth.area || filter_of(s).reads_light_size || baked
               ? ""
               : "without effect: this kernel treats lights as points, and truth.area is off";
}

std::string_view cascades_idle(const Settings& s, int i) {
    if (!source_of(s, i).needs.map) return "without effect: light.source is not a map";
    if (!has_type(s, i, LightType::Directional)) return "without effect: only a directional light has cascades";
    if (!of(s, i).cast) return "without effect: the light casts no shadow";
    if (of(s, i).projection == LightProjection::Perspective)
        return "without effect: cascades are orthographic, but light.projection is perspective";
    if (of(s, i).fit == LightFit::Manual) return "without effect: light.fit is manual, and cascades are fitted";
    return has_clip_levels(s, i) ? "without effect: map.virtual has clip levels in place of cascades" : "";
}

std::string_view between_cascades_idle(const Settings& s, int i) {
    const auto reason = cascades_idle(s, i);
    return reason.empty() && of(s, i).cascades < 2 ? "without effect: light.cascades is 1" : reason;
}

std::string_view lambda_idle(const Settings& s, int i) {
    const auto reason = between_cascades_idle(s, i);
    const bool orthographic = s.camera.source == CameraSource::Manual && s.camera.orthographic;
    return reason.empty() && orthographic ? "without effect: an orthographic camera's cascades are even" : reason;
}

/// Returns the reason why manual split `number`, counted from 1, has no effect.
template <int number>
std::string_view split_idle(const Settings& s, int i) {
    const auto reason = between_cascades_idle(s, i);
    return reason.empty() && of(s, i).cascades <= number ? "without effect: light.cascades has no such border" : reason;
}

/// Returns the reason why settings of the depth range have no effect: clip levels fix the range.
std::string_view near_far_idle(const Settings& s, int i) {
    if (const auto reason = map_idle(s, i); !reason.empty()) return reason;
    if (s.camera.source == CameraSource::Light) return "";
    return has_clip_levels(s, i) ? "without effect: clip levels (map.virtual) hold all depths of the scene" : "";
}

std::string_view depth_bounds_idle(const Settings& s, int i) {
    if (const auto reason = near_far_idle(s, i); !reason.empty()) return reason;
    if (has_type(s, i, LightType::Point)) return "without effect: a point light's faces do not follow the camera";
    if (of(s, i).fit == LightFit::Stabilised) return "without effect: a stabilised map keeps its depths";
    return fit_reads_camera(s, i) ? "" : "without effect: the map does not follow the camera";
}

// Only the angles of a directional light matter, not its place, and an orthographic fit centres itself.
std::string_view place_idle(const Settings& s, int i) {
    const bool camera_there = s.camera.source == CameraSource::Light;
    return has_type(s, i, LightType::Directional) && is_orthographic(s, i) && of(s, i).fit != LightFit::Manual &&
                   !camera_there
               ? "without effect: the fit places the map of a directional light"
               : "";
}

constexpr auto kCount = std::to_array<Param>({
    {.key = "light.count",
     .field = [](Settings& s, int, ObjectSettings*) -> FieldRef { return &s.light_count; },
     .label = "Lights",
     .unit = "lights",
     .min = 0,
     .max = kMaxLights,
     .help = "Number of lights, from light.0 on. Each has its own shadow map.",
     .also = "number of lights, light count"},
});

constexpr auto kLight = with_scope(
    std::to_array<Param>({
        {SI_LIGHT_FIELD(name), .label = "Name", .max = 60,
         .help = "Name of the light for people, such as key or sun. Keys, commands and messages use its number.",
         .also = "rename, label"},
        {SI_LIGHT_FIELD(type), .label = "Type", SI_CHOICES(kTypes), .help = "The kind of light.",
         .also = "sun, lamp, omni, OmniLight, PointLight, SpotLight, DirectionalLight"},
        {SI_LIGHT_FIELD(on), .label = "On",
         .help = "Switches the light on. Off: no map is drawn for it, and it keeps its settings.",
         .also = "enabled, visible, mute, solo"},
        {SI_LIGHT_FIELD(azimuth), .label = "Azimuth", .unit = "deg", .min = -360, .max = 360,
         .help = "Direction from the target to the light, around the vertical axis: 0 is +z, 90 is +x.",
         .also = "sun direction, light rotation, yaw, heading"},
        {SI_LIGHT_FIELD(elevation), .label = "Elevation", .unit = "deg", .min = -90, .max = 90,
         .help = "Direction from the target to the light, above the horizon: 90 is straight overhead.",
         .also = "sun direction, sun height, light rotation, pitch"},
        {SI_LIGHT_FIELD(distance), .label = "Distance", .unit = "m", .min = 0, .max = 1e7, .logarithmic = true,
         .zero_is_auto = true, .idle = place_idle,
         .help = "Distance of the light from its target; 0 lets the fit choose from the scene's size."},
        {SI_LIGHT_FIELD(target_x), .label = "Target x", .unit = "m", .min = -1e8, .max = 1e8, .idle = place_idle,
         .help = "The light's target, along x from the centre of the scene's bounds."},
        {SI_LIGHT_FIELD(target_y), .label = "Target y", .unit = "m", .min = -1e8, .max = 1e8, .idle = place_idle,
         .help = "The light's target, upwards from the centre of the scene's bounds."},
        {SI_LIGHT_FIELD(target_z), .label = "Target z", .unit = "m", .min = -1e8, .max = 1e8, .idle = place_idle,
         .help = "The light's target, along z from the centre of the scene's bounds."},
        {SI_LIGHT_FIELD(size), .label = "Size", .unit = "deg or m", .min = 0, .max = 100, .logarithmic = true,
         .idle = size_idle,
         .help = "Size of the light: angular radius in degrees for directional lights (the sun: 0.27), radius in "
                 "metres for spot and point lights. Larger lights make wider penumbrae.",
         .also =
             "source radius, source angle, contactHardeningLightSizeUVRatio, angular size, angular diameter, softness, "
             "soft falloff, light size, "
             "penumbra, area light, angular distance, light radius, shadow soft size, shadowBulbRadius, penumbraScale"},
        {SI_LIGHT_FIELD(range), .label = "Range", .unit = "m", .min = 0, .max = 1e8, .logarithmic = true,
         SI_IDLE(has_type(s, i, LightType::Directional), "without effect: a directional light reaches everywhere"),
         .help =
             "Distance at which the light has faded to 0; 0 is unlimited. Within the range, the light falls with the "
             "square of the distance. It is also multiplied by max(min(1 - (distance / range)^4, 1), 0), as in glTF. "
             "The fitted map ends at the range too.",
         .also = "attenuation radius, falloff distance, decay"},
        {SI_LIGHT_FIELD(cone), .label = "Cone", .unit = "deg", .min = 0.2, .max = 360,
         SI_IDLE(!has_type(s, i, LightType::Spot), "without effect: only a spot light has a cone"),
         .help =
             "Full opening angle of a spot light. Above 171 degrees its map is drawn as six faces, as a point light's.",
         .also = "spot angle, outer cone angle"},
        {SI_LIGHT_FIELD(cone_blend), .label = "Cone blend", .min = 0, .max = 1,
         SI_IDLE(!has_type(s, i, LightType::Spot), "without effect: only a spot light has a cone"),
         .help = "Share of the cone over which the light fades at its rim: 0 is a hard edge, 1 fades from the axis on.",
         .also = "inner cone angle, spot blend, penumbra"},
        {SI_LIGHT_FIELD(intensity), .label = "Intensity", .min = 0, .max = 1e6, .logarithmic = true,
         .help =
             "Brightness relative to the other lights. The brightness of a directional light is used as given. Spot "
             "and point lights are scaled together so that the brightest of them is 1 at the scene's centre, without "
             "regard to their ranges.",
         .also = "energy, strength, brightness, power"},
        {SI_LIGHT_FIELD(red), .label = "Red", .min = 0, .max = 1, .help = "Colour, linear red.", .also = "light color"},
        {SI_LIGHT_FIELD(green), .label = "Green", .min = 0, .max = 1, .help = "Colour, linear green.",
         .also = "light color"},
        {SI_LIGHT_FIELD(blue), .label = "Blue", .min = 0, .max = 1, .help = "Colour, linear blue.",
         .also = "light color"},
        {SI_LIGHT_FIELD(cast), .label = "Casts shadows",
         .help = "Makes the light cast shadows. Off: everything it reaches is lit, and no map is drawn for it.",
         .also = "castShadow, castShadows, shadow enabled, enable shadows, no shadows"},
        {SI_LIGHT_FIELD(contact), .label = "Contact shadows", .unit = "m", .min = 0, .max = 100, .logarithmic = true,
         SI_IDLE(!of(s, i).cast, "without effect: the light casts no shadow"),
         .help =
             "Length of the ray that is marched from each surface towards the light through the camera's depth "
             "buffer. If a surface blocks the ray, the ray's start is in shadow, whatever light.source says. Contact "
             "shadows restore the small shadows that a bias loses at contacts. Only geometry in the picture counts. "
             "0 is off.",
         .also = "contact shadow length, screen-space shadows, contact distance, screenSpaceContactShadows"},
        {SI_LIGHT_FIELD(source), .label = "Source", .choices = choices_of<sources>,
         SI_IDLE(!of(s, i).cast, "without effect: the light casts no shadow"),
         .help = "The technique that makes the light's shadows. All can be compared with the ray-traced reference.",
         .also = "shadow type, ray-traced shadows, baked shadows, stencil shadows, lightmap, shadowmask, capsule "
                 "shadows, blob shadows, decal shadows"},
        {SI_LIGHT_FIELD(fit), .label = "Fit", .choices = choices_of<fits>, .idle = fit_idle,
         .help = "The region that the shadow map covers.",
         .also = "shadow distance, max distance, shadow camera, stable cascades, stabilized, shadow frustum, stable "
                 "fit, close fit, shadow projection, dynamic shadow distance, directional shadow max distance, "
                 "maxShadowDistance, perspective shadow maps"},
        {SI_LIGHT_FIELD(snap), .label = "Snap to texels",
         SI_IDLE(of(s, i).fit != LightFit::Stabilised || has_type(s, i, LightType::Point),
                 "without effect: only the fit stabilised moves by whole texels, and a point light's faces do not"),
         .help = "Moves the stabilised map by whole texels, so that shadow edges stay unchanged while the camera "
                 "moves. Off: the map follows by fractions of a texel, and edges shimmer.",
         .also = "texel snapping, stable, shimmer, swimming, shimmering, flicker, edge crawling"},
        {SI_LIGHT_FIELD(projection), .label = "Projection", SI_CHOICES(kProjections), .idle = projection_idle,
         .help = "The projection of the shadow map.", .also = "orthographic, perspective, shadow camera"},
        {SI_LIGHT_FIELD(near_far), .label = "Near and far", SI_CHOICES(kNearFar), .idle = near_far_idle,
         .help = "The depth range of the map. Shorter ranges have finer steps.",
         .also = "shadow near plane, near plane offset, pancaking, shadowPancaking, depth range, directional shadow "
                 "pancake size"},
        {SI_LIGHT_FIELD(near), .label = "Near", .unit = "m", .min = 0, .max = 1e8, .logarithmic = true,
         .zero_is_auto = true, .idle = planes_idle,
         .help = "Distance of the map's near plane from the light; 0 is the fit's value. Casters nearer than this are "
                 "lost.",
         .also =
             "shadow near plane, clip start, shadow camera near, shadow.camera.near, shadowNearHint, clipping planes"},
        {SI_LIGHT_FIELD(far), .label = "Far", .unit = "m", .min = 0, .max = 1e8, .logarithmic = true,
         .zero_is_auto = true, .idle = planes_idle,
         .help = "Distance of the map's far plane from the light; 0 is the fit's value. A longer range makes coarser "
                 "steps of depth.",
         .also = "shadow far, clip end, max distance, shadow distance, shadow camera far, shadow.camera.far, "
                 "shadowFar, shadowFarHint, clipping planes"},
        {SI_LIGHT_FIELD(stretch), .label = "Range factor", .min = 1, .max = 1e5, .logarithmic = true,
         .idle = near_far_idle,
         .help =
             "Factor by which the depth range is longer than the range from near to far. Under parallel light the "
             "range grows around its middle. Under spot and point lights, near is divided by the factor, and far is "
             "multiplied by it. Steps of stored depth grow with the range. A factor of 1 changes nothing."},
        {SI_LIGHT_FIELD(extent), .label = "Extent", .unit = "m", .min = 0, .max = 1e8, .logarithmic = true,
         .idle = extent_idle,
         .help = "Half the width of an orthographic map, or of a spot light's at its target, at most its cone's; 0 is "
                 "the fit's value. A texel is 2 * extent / map.resolution wide there.",
         .also = "orthographicSize, ortho size, ortho scale, shadow camera size, left, right, top, bottom"},
        {SI_LIGHT_FIELD(cascades), .label = "Cascades", .unit = "maps", .min = 1, .max = kMaxCascades,
         .idle = cascades_idle,
         .help = "Number of maps of a directional light. Each covers the visible receivers in one interval of camera "
                 "depth, at map.resolution. 1 is the single map of light.fit.",
         .also = "cascade count, CSM, PSSM, shadow splits, num dynamic shadow cascades, shadowCascades, directional "
                 "shadow mode, cascaded shadow maps"},
        {SI_LIGHT_FIELD(depth_bounds), .label = "Depth range from", SI_CHOICES(kDepthBounds), .idle = depth_bounds_idle,
         .help = "The camera depths that cascades and fits to the view frustum cover."},
        {SI_LIGHT_FIELD(split), .label = "Split", .choices = choices_of<splits>, .idle = between_cascades_idle,
         .help = "The division of the camera's depth among cascades.",
         .also = "cascade splits, cascade distribution, partition, split distance, cascadeSplitPositions"},
        {SI_LIGHT_FIELD(split_lambda), .label = "Split lambda", .min = 0, .max = 1, .idle = lambda_idle,
         .help = "The division of the camera's depth among cascades: 0 even, 1 by equal ratios, between them their "
                 "weighted mean (Zhang et al., 2006).",
         .also = "cascade distribution exponent, PSSM lambda, fade-in"},
        {SI_LIGHT_FIELD(split_1), .label = "Split 1", .min = 0, .max = 1, .idle = split_idle<1>,
         .help = "Far end of the first cascade, as a share of the divided depths: 0 is the nearest. An edit moves the "
                 "splits that it passes.",
         .also = "split distance, directional shadow split"},
        {SI_LIGHT_FIELD(split_2), .label = "Split 2", .min = 0, .max = 1, .idle = split_idle<2>,
         .help = "Far end of the second cascade, as a share of the divided depths: 0 is the nearest. An edit moves the "
                 "splits that it passes.",
         .also = "split distance, directional shadow split"},
        {SI_LIGHT_FIELD(split_3), .label = "Split 3", .min = 0, .max = 1, .idle = split_idle<3>,
         .help = "Far end of the third cascade, as a share of the divided depths: 0 is the nearest. An edit moves the "
                 "splits that it passes.",
         .also = "split distance, directional shadow split"},
        {SI_LIGHT_FIELD(split_4), .label = "Split 4", .min = 0, .max = 1, .idle = split_idle<4>,
         .help = "Far end of the fourth cascade, as a share of the divided depths: 0 is the nearest. An edit moves the "
                 "splits that it passes.",
         .also = "split distance"},
        {SI_LIGHT_FIELD(split_5), .label = "Split 5", .min = 0, .max = 1, .idle = split_idle<5>,
         .help = "Far end of the fifth cascade, as a share of the divided depths: 0 is the nearest. An edit moves the "
                 "splits that it passes.",
         .also = "split distance"},
        {SI_LIGHT_FIELD(split_6), .label = "Split 6", .min = 0, .max = 1, .idle = split_idle<6>,
         .help = "Far end of the sixth cascade, as a share of the divided depths: 0 is the nearest. An edit moves the "
                 "splits that it passes.",
         .also = "split distance"},
        {SI_LIGHT_FIELD(split_7), .label = "Split 7", .min = 0, .max = 1, .idle = split_idle<7>,
         .help = "Far end of the seventh cascade, as a share of the divided depths: 0 is the nearest. An edit moves "
                 "the splits that it passes.",
         .also = "split distance"},
        {SI_LIGHT_FIELD(cascade_blend), .label = "Cascade blend", .min = 0, .max = 1, .idle = between_cascades_idle,
         .help = "Share of a cascade's interval, at its end, over which the next one's shadow is blended in; both are "
                 "read there. 0 changes from one to the next at once.",
         .also = "cascade border, transition fraction, blend splits, cascade fade, directional shadow blend splits, "
                 "cascade transition"},
        {SI_LIGHT_FIELD(cascade_choice), .label = "Cascade selection", SI_CHOICES(kCascadeChoices),
         .idle = between_cascades_idle, .help = "The cascade in which a point is looked up."},
    }),
    Scope::Light);
static_assert(kLight.size() == member_count<LightSettings>(), "a member of LightSettings has no row");

}  // namespace

std::vector<Param> light_rows() {
    return joined(kCount, kLight);
}

}  // namespace si
