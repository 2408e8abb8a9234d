#include "renderer/view/light_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/angles.h"
#include "renderer/base/finite.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/sources.h"
#include "renderer/view/camera.h"
#include "renderer/view/cascades.h"
#include "renderer/view/fit_bounds.h"
#include "renderer/view/map_limits.h"
#include "renderer/view/projection.h"

namespace si {
namespace {

constexpr double kMinHalfAngle = 1e-3, kMaxHalfAngle = 1.5;  // rad; tan() stays below 15
constexpr double kMarginTexels = 2;  // at each side, so that a kernel at the edge of the scene finds cleared texels
constexpr double kMostOffsetTexels = 32;  // beyond it a normal offset leads where the map ends
constexpr double kMarginSteps = 64;       // in the map's width, of the margin of a region
constexpr double kNearShare = 1e-3;       // least near / far of a perspective map: D24 then resolves far / 2e4
constexpr double kDepthMargin = 1e-4;     // of the depth range, at each end
constexpr double kNearestSplit = 1e-3;    // of the farthest depth: a camera within the scene sees surfaces at 0 m
// 2^10 steps of a float: a thinner range or map has no useful resolution.
constexpr double kMinShare = 1024.0 / (1 << 23);

/// Half extent plus the margin in texels, at least a thousand float steps of `scale`.
double with_margin(double half, double scale, int resolution, double margin = kMarginTexels) {
    const double share = resolution > 4 * margin ? 1 - 2 * margin / resolution : 0.5;
    return std::max(half, kMinShare * scale) / share;
}

/// Makes the range of `curve` positive: at least two texels and a thousand float steps of `scale`, about the same
/// middle.
void widen_range(DepthCurve& curve, double texel, double scale) {
    const double least = std::max({2 * texel, kMinShare * scale, 1e-12});
    if (curve.far - curve.near >= least) return;
    const double middle = 0.5 * (curve.near + curve.far);
    curve.near = middle - 0.5 * least;
    curve.far = middle + 0.5 * least;
    if (curve.perspective && curve.near < kNearShare * curve.far) {
        curve.near = kNearShare * curve.far;
        curve.far = curve.near + least;
    }
}

void note(PlacedLight& light, std::string text) {
    if (std::find(light.notes.begin(), light.notes.end(), text) == light.notes.end())
        light.notes.push_back(std::move(text));
}

/// light.near and light.far in place of the fitted range, where they make sense.
void manual_range(FittedLight& light, const LightSettings& s, DepthCurve& curve) {
    if (s.fit != int(LightFit::Manual)) return;
    const double near = finite_or(s.near, 0), far = finite_or(s.far, 0);
    if (near != 0 && (near > 0 || !curve.perspective)) curve.near = near;
    if (far != 0) curve.far = far;
    if (near < 0 && curve.perspective) note(light, "a perspective map needs near > 0: light.near is fitted instead");
    if (!(curve.far > curve.near)) {
        note(light,
             fmt::format("near {:.6g} m is not below far {:.6g} m: far is moved behind near", curve.near, curve.far));
        curve.far = curve.near + std::max(std::abs(curve.near), 1e-6);
    }
}

/// Kernels cross from one face of six into the next; a texel more for the normal offset's.
double face_margin_texels(const Settings& settings) {
    return std::max(6.0, std::ceil(reach_of(settings).read) + 1);
}

/// What the fit of one light goes by.
struct FitContext {
    const Scene& scene;
    const SceneShape& shape;
    const LightSettings& settings;
    DepthConvention convention;
    int resolution;
    double face_margin_texels;
    double reach_m;  ///< how far a spot or point light shines; infinite when unlimited
    const Camera* camera;
    double margin_texels;  ///< fit_margin_texels()
};

double size_of(const LightSettings& s) {
    const double size = positive_or(s.size, 0);
    return s.type == int(LightType::Directional) ? std::tan(std::min(size, 89.0) * kDegree) : size;
}

double range_of(const LightSettings& s) {
    return s.type == int(LightType::Directional) ? 0 : positive_or(s.range, 0);
}

void finish_view(FittedLight& light, LightView view, const FitContext& c, double reference_z) {
    manual_range(light, c.settings, view.curve);
    // An orthographic depth is affine: only what doubles resolve that far from the light matters besides the scene.
    const double scale =
        view.curve.perspective ? view.curve.far : std::max(c.shape.radius, 0x1p-30 * std::abs(view.curve.far));
    widen_range(view.curve, view.texel_size(reference_z, c.resolution), scale);
    view.projection = projection_matrix(view.curve, view.half_width, view.half_width);
    light.views.push_back(view);
}

/// Half extent in metres by hand, or 0.
double manual_half_extent(const LightSettings& s) {
    return s.fit == int(LightFit::Manual) ? positive_or(s.extent, 0) : 0;
}

/// An orthographic map over all boxes (`half` 0) or of a given half extent about the view's axis.
void fit_orthographic(FittedLight& light, LightView view, const FitContext& c, double half, bool in_front_only) {
    const double manual = manual_half_extent(c.settings);
    if (manual > 0) half = manual;
    ViewExtent e = extent_of(c.shape, view);
    if (half <= 0) {
        const glm::dvec3 middle = 0.5 * (e.lo + e.hi);
        view.eye += view.axes * glm::dvec3(middle.x, middle.y, 0);
        half = with_margin(0.5 * std::max(e.hi.x - e.lo.x, e.hi.y - e.lo.y), c.shape.radius, c.resolution);
    }
    view.half_width = half;
    view.curve.perspective = false;
    view.curve.convention = c.convention;
    if (in_front_only) {
        e.lo.z = std::clamp(e.lo.z, 0.0, c.reach_m);
        e.hi.z = std::clamp(e.hi.z, e.lo.z, c.reach_m);
    }
    const double pad = kDepthMargin * (e.hi.z - e.lo.z);
    view.curve.near = e.lo.z - pad;
    view.curve.far = e.hi.z + pad;
    finish_view(light, view, c, 1);
}

/// The range of what lies inside the view's pyramid and the light's range.
DepthCurve perspective_curve(const LightView& view, const FitContext& c) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const Box& box : c.shape.boxes) {
        const ViewExtent e = extent_of(box, view);
        const double entry = entry_into_pyramid(e, view.half_width);
        if (!std::isfinite(entry) || e.hi.z <= 0) continue;
        nearest = std::min(nearest, entry);
        farthest = std::max(farthest, e.hi.z);
    }
    if (!(farthest > 0)) nearest = farthest = std::max(glm::distance(view.eye, c.shape.centre), c.shape.radius);
    nearest = std::min(nearest, c.reach_m);
    farthest = std::min(farthest, c.reach_m);
    DepthCurve curve;
    curve.perspective = true;
    curve.convention = c.convention;
    curve.far = farthest * (1 + kDepthMargin);
    curve.near = std::max(nearest * (1 - kDepthMargin), kNearShare * curve.far);
    return curve;
}

/// A perspective map of tangent `tan_half`; 0 chooses it so that every box is inside.
void fit_perspective(FittedLight& light, LightView view, const FitContext& c, double tan_half) {
    if (tan_half <= 0) {
        double tangent = kMinHalfAngle;
        for (const Box& box : c.shape.boxes)
            for (const glm::dvec3& p : box) {
                const glm::dvec3 v = glm::transpose(view.axes) * (p - view.eye);
                const double aside = std::max(std::abs(v.x), std::abs(v.y));
                tangent = std::max(tangent, -v.z > 0 ? aside / -v.z : std::tan(kMaxHalfAngle));
            }
        const double limit = std::tan(kMaxHalfAngle);
        tan_half = std::min(with_margin(tangent, tangent, c.resolution), limit);
        if (tan_half == limit) note(light, "the light stands in the scene: its map covers 172 degrees only");
    }
    view.half_width = tan_half;
    view.curve = perspective_curve(view, c);
    finish_view(light, view, c, view.curve.far);
}

/// Right, up and back of the six faces, oriented like the faces of a GL cube map.
const std::array<glm::dmat3, 6>& cube_axes() {
    static const std::array<glm::dmat3, 6> axes = [] {
        const std::array<std::pair<glm::dvec3, glm::dvec3>, 6> forward_up = {{{{1, 0, 0}, {0, -1, 0}},
                                                                              {{-1, 0, 0}, {0, -1, 0}},
                                                                              {{0, 1, 0}, {0, 0, 1}},
                                                                              {{0, -1, 0}, {0, 0, -1}},
                                                                              {{0, 0, 1}, {0, -1, 0}},
                                                                              {{0, 0, -1}, {0, -1, 0}}}};
        std::array<glm::dmat3, 6> result;
        for (int i = 0; i < 6; ++i) {
            const auto& [forward, up] = forward_up[i];
            result[i] = glm::dmat3(glm::cross(forward, up), up, -forward);
        }
        return result;
    }();
    return axes;
}

/// Six faces of one range, so that a depth means the same distance in each.
void fit_faces(FittedLight& light, const FitContext& c) {
    std::array<LightView, 6> faces;
    DepthCurve range;
    for (int i = 0; i < 6; ++i) {
        faces[i].eye = light.position;
        faces[i].axes = cube_axes()[i];
        faces[i].half_width = with_margin(1.0, 0, c.resolution, c.face_margin_texels);
        const DepthCurve curve = perspective_curve(faces[i], c);
        if (i == 0) range = curve;
        range.near = std::min(range.near, curve.near);
        range.far = std::max(range.far, curve.far);
    }
    range.near = std::max(range.near, kNearShare * range.far);
    for (LightView& face : faces) {
        face.curve = range;
        finish_view(light, face, c, range.far);
    }
    light.chooser = {ViewChoice::Face, light.position, {}, {}};
    if (c.settings.projection == int(LightProjection::Orthographic))
        note(light, "six faces are always perspective: light.projection has no effect");
}

/// How far from where a surface lies in the map a look-up of it may lead: the kernel's reach, the normal offset, what
/// depth blur brings from aside, and half a texel of each end.
double reach_of_lookups(const Settings& s) {
    return reach_of(s).read + std::max(s.bias.normal, 0.0) + s.map.blur_texels + 1;
}

/// The map of one cascade: what it holds across the light is what the camera sees of receivers in its depths; towards
/// the light it reaches to the first caster.
void fit_cascade(FittedLight& light, LightView view, const FitContext& c, const Camera& camera, const DepthSpan& span,
                 double margin) {
    ViewExtent seen;
    const CameraSlice slice(camera, span.from_m, span.to_m);
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) {
        if (!c.shape.box_receives[i]) continue;
        seen.add(extent_of(slice.seen_of(c.shape.boxes[i]), view));
    }
    if (!(seen.lo.x <= seen.hi.x)) seen = extent_of(c.shape, view);  // nothing will be looked up in it
    const glm::dvec3 middle = 0.5 * (seen.lo + seen.hi);
    view.half_width =
        with_margin(0.5 * std::max(seen.hi.x - seen.lo.x, seen.hi.y - seen.lo.y), c.shape.radius, c.resolution, margin);
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) {
        if (!c.shape.box_casts[i]) continue;
        const ViewExtent e = extent_of(c.shape.boxes[i], view);
        const bool beside = e.hi.x < middle.x - view.half_width || e.lo.x > middle.x + view.half_width ||
                            e.hi.y < middle.y - view.half_width || e.lo.y > middle.y + view.half_width;
        if (!beside) seen.lo.z = std::min(seen.lo.z, e.lo.z);
    }
    view.eye += view.axes * glm::dvec3(middle.x, middle.y, 0);
    view.curve.perspective = false;
    view.curve.convention = c.convention;
    const double pad = kDepthMargin * (seen.hi.z - seen.lo.z);
    view.curve.near = seen.lo.z - pad;
    view.curve.far = seen.hi.z + pad;
    finish_view(light, view, c, 1);
}

/// Several maps of a directional light, each for an interval of the camera's depth.
void fit_cascades(FittedLight& light, const FitContext& c, const Settings& settings, const Camera& camera) {
    const int count = std::clamp(c.settings.cascades, 1, kMaxCascades);
    const double blend = std::clamp(finite_or(c.settings.cascade_blend, 0), 0.0, 1.0);
    LightView view;
    view.axes = orthonormal_basis(light.to_light);
    view.eye = light.position;
    const DepthSpan all = seen_depths(camera, c.shape.boxes, c.shape.box_receives)
                              .value_or(DepthSpan{camera.curve.near, camera.curve.far});
    // Parallel rays of the camera see all depths at one size, for which even cascades are right.
    const double lambda = camera.orthographic ? 0 : std::clamp(finite_or(c.settings.split_lambda, 0.5), 0.0, 1.0);
    const double nearest = camera.orthographic ? all.from_m : std::max(all.from_m, kNearestSplit * all.to_m);
    const std::vector<double> ends = split_depths(nearest, all.to_m, count, lambda);
    const double margin = reach_of_lookups(settings);
    const bool by_map = c.settings.cascade_choice == int(CascadeChoice::Map);
    light.chooser = {by_map ? ViewChoice::Map : ViewChoice::Interval, camera.eye, -camera.axes[2], {}};
    double begins = all.from_m, holds_from = begins;
    for (int i = 0; i < count; ++i) {
        const double end = ends[std::size_t(i)], blends_from = i + 1 < count ? end - blend * (end - begins) : end;
        fit_cascade(light, view, c, camera, {holds_from, end}, margin);
        const double rim = std::max(0.5 - (margin - 0.5) / c.resolution, 0.3);  // holds what the fit was for
        if (by_map)
            light.chooser.spans.push_back({rim, i + 1 < count ? rim * (1 - blend) : rim});
        else
            light.chooser.spans.push_back({end, blends_from});
        begins = end, holds_from = blends_from;
    }
}

/// Half the cone's angle in radians, clamped.
double half_cone(PlacedLight& light, const LightSettings& s) {
    double half = 0.5 * s.cone * kDegree;
    if (std::isnan(half) || half < kMinHalfAngle) {
        note(light, fmt::format("light.cone {:.4g} degrees is too narrow: {:.3g} is used", s.cone,
                                2 * kMinHalfAngle / kDegree));
        half = kMinHalfAngle;
    }
    return std::min(half, std::numbers::pi);
}

void place_spot(PlacedLight& light, const LightSettings& s) {
    light.half_cone_rad = half_cone(light, s);
    const double blend = std::clamp(finite_or(s.cone_blend, 0), 0.0, 1.0);
    light.cos_cone_outer = std::cos(light.half_cone_rad);
    light.cos_cone_inner = std::cos(light.half_cone_rad * (1 - blend));
    light.six_faces = light.half_cone_rad > kMaxHalfAngle;
    if (light.six_faces) note(light, "the cone is wider than one map can hold: it is drawn as six faces");
}

/// How far from its target a light stands where the settings leave it open.
double automatic_distance(const PlacedLight& light, const LightSettings& s, double radius) {
    switch (light.type) {
        case LightType::Directional:
            return (s.projection == int(LightProjection::Perspective) ? 4 : 2) * radius;
        case LightType::Spot:  // far enough for the sphere around the scene to fit into the cone
            return radius / std::sin(std::min(light.half_cone_rad, kMaxHalfAngle));
        case LightType::Point:
            break;
    }
    return 1.5 * radius;
}

PlacedLight place(const LightSettings& s, const SceneShape& shape) {
    PlacedLight light;
    light.type = LightType(std::clamp(s.type, 0, 2));
    light.to_light = direction_from_angles(finite_or(s.azimuth, -40), finite_or(s.elevation, 45));
    light.radiance = positive_or(s.intensity, 0) *
                     glm::dvec3(positive_or(s.red, 0), positive_or(s.green, 0), positive_or(s.blue, 0));
    light.target =
        shape.centre + glm::dvec3(finite_or(s.target_x, 0), finite_or(s.target_y, 0), finite_or(s.target_z, 0));
    light.map_origin = shape.centre;
    light.range_m = range_of(s);
    light.size = size_of(s);
    if (light.type == LightType::Spot) place_spot(light, s);
    if (light.type == LightType::Point) light.six_faces = true;
    light.distance_m = positive_or(s.distance, automatic_distance(light, s, shape.radius));
    light.position = light.target + light.to_light * light.distance_m;
    return light;
}

/// A map narrowed to a region: about the region's middle, or in perspective about the light's axis.
void fit_region(FittedLight& light, LightView view, const FitContext& c, const MapRegion& region) {
    light.closed = true;
    if (view.curve.perspective) {
        const glm::dvec2 aside = glm::max(glm::abs(region.lo), glm::abs(region.hi));
        const double tangent = std::max({aside.x, aside.y, kMinHalfAngle});
        return fit_perspective(light, view, c,
                               std::min(with_margin(tangent, tangent, c.resolution, c.margin_texels),
                                        with_margin(view.half_width, 0, c.resolution)));
    }
    const glm::dvec2 size = region.hi - region.lo;
    view.eye += view.axes * glm::dvec3(0.5 * (region.lo + region.hi), 0);
    view.half_width = with_margin(0.5 * std::max(size.x, size.y), c.shape.radius, c.resolution, c.margin_texels);
    view.curve.convention = c.convention;
    ViewExtent held;
    for (const Box& box : c.shape.boxes) held.add(extent_within(box, view));
    if (!(held.lo.z <= held.hi.z)) held = extent_of(c.shape, view);  // too far away for doubles to tell
    const double pad = kDepthMargin * (held.hi.z - held.lo.z);
    view.curve.near = held.lo.z - pad;
    view.curve.far = held.hi.z + pad;
    finish_view(light, view, c, 1);
}

/// Whether the light's map is divided among views of the camera's depths.
bool has_cascades(const LightSettings& s) {
    return s.cascades > 1 && s.type == int(LightType::Directional) && s.fit != int(LightFit::Manual) &&
           s.projection != int(LightProjection::Perspective);
}

void fit_one_view(FittedLight& light, const FitContext& c) {
    LightView view;
    view.axes = orthonormal_basis(light.to_light);
    view.eye = light.position;
    const bool directional = light.type == LightType::Directional;
    // As the cone's circle touches the map's sides, only kernels at its rim need the margin.
    double tangent = directional ? 0 : with_margin(std::tan(light.half_cone_rad), 0, c.resolution);
    const int projection = c.settings.projection;
    const bool perspective = directional ? projection == int(LightProjection::Perspective)
                                         : projection != int(LightProjection::Orthographic);
    if (perspective != directional) {  // else its rays are not the light's
        view.curve.perspective = perspective;
        view.half_width = directional ? 1 : std::tan(light.half_cone_rad);
        const FitInput input{c.scene, c.shape, view, c.reach_m, c.camera};
        if (const auto region = fit_row(c.settings.fit).find(input)) return fit_region(light, view, c, *region);
    }
    if (perspective) {
        const double by_hand = directional ? 0 : manual_half_extent(c.settings) / light.distance_m;
        if (by_hand > 0) tangent = std::min(tangent, std::max(by_hand, kMinHalfAngle));
        fit_perspective(light, view, c, tangent);
    } else {
        fit_orthographic(light, view, c, tangent * light.distance_m, !directional);
    }
}

/// Whether any box begins within the range; along the views' axes, so that a few may pass that do not.
bool reaches_anything(const FittedLight& light, const SceneShape& shape) {
    return std::any_of(shape.boxes.begin(), shape.boxes.end(), [&](const Box& box) {
        return std::any_of(light.views.begin(), light.views.end(), [&](const LightView& view) {
            const ViewExtent e = extent_of(box, view);
            const double z = view.curve.perspective ? entry_into_pyramid(e, view.half_width) : e.lo.z;
            return e.hi.z > 0 && z < light.range_m;
        });
    });
}

/// Divides spot and point radiances by what the brightest of them brings to the scene's centre, where the shaders'
/// 1/d^2 makes it 1 again. Nearer than a quarter of the scene's radius counts as that far.
void normalise_punctual(std::vector<PlacedLight>& lights, const Settings& settings, const SceneShape& shape) {
    double brightest = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (lights[i].type == LightType::Directional) continue;
        const double d = std::max(glm::distance(lights[i].position, shape.centre), 0.25 * shape.radius);
        const double intensity = positive_or(settings.lights[i].intensity, 0);
        brightest = std::max(brightest, intensity / (d * d));
    }
    if (!(brightest > 0)) return;
    for (PlacedLight& light : lights)
        if (light.type != LightType::Directional) light.radiance /= brightest;
}

}  // namespace

glm::dmat3 orthonormal_basis(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

glm::dvec3 direction_from_angles(double azimuth_deg, double elevation_deg) {
    const SineCosine az = sine_cosine(azimuth_deg), el = sine_cosine(elevation_deg);
    return glm::dvec3(el.cosine * az.sine, el.sine, el.cosine * az.cosine) + 0.0;  // no zero has a sign
}

PlacedLights place_lights(const Scene& scene, const Settings& settings) {
    const auto shape = std::make_shared<const SceneShape>(scene_shape(scene, settings));
    PlacedLights out{shape, {}};
    for (int i = 0; i < std::clamp(settings.light_count, 0, kMaxLights); ++i)
        out.lights.push_back(place(settings.lights[std::size_t(i)], *shape));
    normalise_punctual(out.lights, settings, *shape);
    return out;
}

bool fit_reads_camera(const Settings& settings, int light) {
    const LightSettings& s = settings.lights[std::size_t(light)];
    return has_cascades(s) || fit_row(s.fit).reads_camera;
}

double fit_margin_texels(const Settings& settings, int resolution) {
    const Reach reach = reach_of(settings);
    const double offset = std::clamp(finite_or(settings.bias.normal, 0), BiasSettings().normal, kMostOffsetTexels);
    const double texels = std::ceil(std::max(reach.edge, reach.read) + settings.map.blur_texels + offset) + 2;
    const double step = std::max(resolution / kMarginSteps, 1.0);
    return step * std::ceil(texels / step);
}

std::vector<FittedLight> fit_maps(const PlacedLights& placed, const Scene& scene, const Settings& settings,
                                  const Camera* camera, int max_resolution) {
    const SceneShape& shape = *placed.shape;
    const int resolution = std::clamp(settings.map.resolution, 1, std::max(1, max_resolution));
    std::vector<FittedLight> lights;
    for (std::size_t i = 0; i < placed.lights.size(); ++i) {
        const LightSettings& s = settings.lights[i];
        FittedLight& light = lights.emplace_back();
        static_cast<PlacedLight&>(light) = placed.lights[i];
        const FitContext context{scene,
                                 shape,
                                 s,
                                 {true, settings.map.reversed_z},
                                 resolution,
                                 face_margin_texels(settings),
                                 light.range_m > 0 ? light.range_m : std::numeric_limits<double>::infinity(),
                                 camera,
                                 fit_margin_texels(settings, resolution)};
        if (light.six_faces)
            fit_faces(light, context);
        else if (camera && has_cascades(s))
            fit_cascades(light, context, settings, *camera);
        else
            fit_one_view(light, context);
        if (light.range_m > 0 && !reaches_anything(light, shape))
            note(light, fmt::format("light.range: nothing lies within {:.4g} m of light {}", light.range_m, i));
        if (!s.cast)
            light.reason = "light.cast is off";
        else if (!shape.triangles)
            light.reason = "the scene has no triangles";
        else if (!shape.casters)
            light.reason = "no object casts";
        else if (!shape.receivers)
            light.reason = "no object receives shadows";
        light.shadowed = light.reason.empty();
        if (const Source& source = source_of(settings, i); light.shadowed && !source.needs.map)
            light.reason = fmt::format("light.source is {}, which needs no map", source.key);
        light.casts = light.reason.empty();
        if (!light.casts) continue;
        light.clipped_casters = count_clipped(shape, light.views);
        light.limits = map_limits(shape, light.views, MapFormat(settings.map.format), resolution);
        for (std::string& text : map_limit_notes(light.limits, int(i))) note(light, std::move(text));
    }
    return lights;
}

std::vector<FittedLight> fit_lights(const Scene& scene, const Settings& settings, const Camera* camera) {
    return fit_maps(place_lights(scene, settings), scene, settings, camera);
}

}  // namespace si
