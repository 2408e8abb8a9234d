#include "renderer/view/fits/light_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/finite.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/paging.h"
#include "renderer/settings/sources.h"
#include "renderer/view/bounds/convex.h"
#include "renderer/view/cascades/clip_levels.h"
#include "renderer/view/culling/box_culling.h"
#include "renderer/view/culling/needed_maps.h"
#include "renderer/view/fits/fit_context.h"
#include "renderer/view/fits/map_limits.h"
#include "renderer/view/fits/near_far.h"

namespace si {
namespace {

constexpr double kMinOffsetTexels = 3;   // smaller normal offsets leave the region as it is
constexpr double kMaxOffsetTexels = 32;  // largest normal offset in texels that the margin covers
constexpr double kMarginSteps = 64;      // steps of the margin in a map's width

/// Returns true when a box may begin within the range. Distances are measured along the views' axes, so a few boxes
/// outside may pass.
bool reaches_anything(const FittedLight& light, const SceneShape& shape) {
    return std::any_of(shape.boxes.begin(), shape.boxes.end(), [&](const Box& box) {
        return std::any_of(light.views.begin(), light.views.end(), [&](const LightView& view) {
            const ViewExtent e = extent_in_view(box, view);
            const double z = view.curve.perspective ? pyramid_entry_m(e, view.cross_section()) : e.lo.z;
            return e.hi.z > 0 && z < light.range_m;
        });
    });
}

std::string why_dark(const FittedLight& light, const Scene& scene) {
    if (light.radiance == glm::dvec3(0)) return kLightAddsNothing;
    if (light.type == LightType::Directional) return {};
    const bool arrives = std::ranges::any_of(scene.objects, [&](const Object& object) {
        const Bounds& bounds = scene.meshes[std::size_t(object.mesh)].bounds;
        return !bounds.empty() && may_illuminate(light, bounds.corners(object.world));
    });
    return arrives ? "" : "nothing lies within the light's range and cone";
}

SkewBox skew_box(const Box& corners) {
    SkewBox box;
    box.centre = 0.5 * (corners[0] + corners[7]);
    for (int i = 0; i < 3; ++i) box.half[i] = 0.5 * (corners[std::size_t(1) << i] - corners[0]);
    return box;
}

/// Returns points around the part of a box inside a view and the light's range.
std::vector<glm::dvec3> points_in_view(const Box& box, const LightView& view, double range_m) {
    if (!view.curve.perspective) return {box.begin(), box.end()};
    double far = 0;
    for (const glm::dvec3& p : box) far = std::max(far, 1.01 * glm::distance(p, view.eye));
    if (range_m > 0) far = std::min(far, 1.01 * range_m);
    const Box pyramid = view_pyramid(view, 1e-4 * far, far, 1.01);
    const std::vector<HalfSpace> sides = box_half_spaces(pyramid);
    const ConvexBody body{pyramid, sides};
    return intersection_points(box, {&body, 1});
}

/// Least distance before the far plane, as a share of the depth range, at which an empty map is lit despite float
/// rounding.
constexpr double kMinFarMargin = 1e-5;

bool lies_before_far(const Box& box, const LightView& view, double range_m) {
    const DepthCurve& c = view.curve;
    return std::ranges::all_of(points_in_view(box, view, range_m), [&](const glm::dvec3& p) {
        const double z = -glm::dot(view.axes[2], p - view.eye);
        const double before = (c.far - z) / (c.far - c.near);
        return before * (c.perspective ? c.near / std::max(z, c.near) : 1) > kMinFarMargin;
    });
}

/// Returns the reason why a light's maps stay empty with all lit surfaces before their far plane; else an empty text.
std::string why_empty(const FittedLight& light, const SceneShape& shape, const FitContext& c) {
    for (const LightView& view : light.views) {
        const BoxCuller sight(view.clip_from_relative(light.map_origin), light.map_origin, view.curve.convention,
                              view.clamps_near, c.resolution);
        for (std::size_t i = 0; i < shape.boxes.size(); ++i) {
            const Box& box = shape.boxes[i];
            if (shape.box_casts[i] && !sight.is_outside(skew_box(box))) return {};
            if (shape.box_receives[i] && may_illuminate(light, box) && !lies_before_far(box, view, light.range_m))
                return {};
        }
    }
    return "no caster lies in its map: all surfaces that it reaches are lit";
}

/// Fits clip levels around the camera, whose pages are drawn on demand.
void fit_clip_levels(FittedLight& light, const FitContext& c, const Camera& camera, int picture_lines) {
    const Settings& settings = c.all_settings;
    ClipLevels found = clip_levels({.to_light = light.to_light,
                                    .convention = c.convention,
                                    .resolution = c.resolution,
                                    .page_texels = page_texels(settings),
                                    .count = std::clamp(settings.map.virtual_levels, 1, kMaxClipLevels),
                                    .bias = finite_or(settings.map.virtual_bias, 0),
                                    .margin_texels = lookup_reach_texels(settings),
                                    .picture_lines = picture_lines},
                                   c.shape, camera);
    light.views = std::move(found.views);
    light.levels = std::move(found.levels);
    light.chooser = std::move(found.chooser);
    light.map_origin = page_origin(c.shape);
}

/// Fits the maps of a light to its context.
void fit_views(FittedLight& light, const FitContext& c, int light_index, int picture_lines) {
    if (light.six_faces)
        fit_faces(light, c);
    else if (c.camera && has_clip_levels(c.all_settings, light_index))
        fit_clip_levels(light, c, *c.camera, picture_lines);
    else if (c.camera && uses_camera_slices(c.settings))
        fit_cascades(light, c, *c.camera);
    else
        fit_one_view(light, c);
}

/// Returns a length in the smallest texels of a light's maps, at most kMaxOffsetTexels.
double in_texels(const std::vector<LightView>& views, double length_m, int resolution) {
    double texels = 0;
    for (const LightView& view : views)
        texels = std::max(texels, length_m / view.texel_size_range(resolution).shortest);
    return std::min(texels, kMaxOffsetTexels);
}

}  // namespace

bool adds_no_light(const FittedLight& light, const Settings& settings) {
    return !light.dark.empty() && settings.shading.composition != Composition::DimLit;
}

bool is_always_lit(const FittedLight& light, const Settings& settings) {
    const Filter& kernel = filter_of(settings);
    const bool compares = kernel.samples() == Samples::Depth && (!kernel.reads_light_size || kernel.searches_blockers);
    // Bias must move lit surfaces towards the light.
    const BiasSettings& b = settings.bias;
    const bool nearer = b.constant >= 0 && b.slope >= 0 &&
                        (b.normal == 0 || (b.normal > 0 && b.normal_source == NormalSource::Geometric));
    return light.provider == MapProvider::Drawn && !light.empty.empty() && compares && nearer &&
           !compares_per_texel(settings) && !draws_pages(settings) && settings.map.outside == Outside::Lit &&
           settings.map.compare == Compare::LessEqual;
}

double fit_margin_texels(const Settings& settings, int resolution) {
    const Reach reach = reach_of(settings);
    const double offset = std::clamp(finite_or(settings.bias.normal_texels(), 0), kMinOffsetTexels, kMaxOffsetTexels);
    const double texels = std::ceil(std::max(reach.edge, reach.read) + settings.map.blur_texels + offset) + 2;
    const double step = std::max(resolution / kMarginSteps, 1.0);
    return step * std::ceil(texels / step);
}

std::vector<FittedLight> fit_maps(const PlacedLights& placed, const Scene& scene, const Settings& settings,
                                  const Camera* camera, int max_resolution, const std::optional<DepthSpan>& seen_m,
                                  int picture_lines) {
    const int resolution = std::clamp(settings.map.resolution, 1, std::max(1, max_resolution));
    std::vector<FittedLight> lights;
    for (std::size_t i = 0; i < placed.lights.size(); ++i) {
        const LightSettings& s = settings.lights[i];
        FittedLight& light = lights.emplace_back();
        static_cast<PlacedLight&>(light) = placed.lights[i];
        const SceneShape& shape = *placed.shapes[i];
        const auto context_of = [&](const Settings& all, double normal_m) {
            return FitContext{scene,
                              shape,
                              s,
                              all,
                              {true, settings.map.reversed_z},
                              resolution,
                              face_margin_texels(all),
                              light.range_m > 0 ? light.range_m : std::numeric_limits<double>::infinity(),
                              camera,
                              fit_margin_texels(all, resolution),
                              fit_reads_measured_depths(settings, int(i)) ? seen_m : std::nullopt,
                              normal_m};
        };
        // A normal offset in metres is a number of texels once the maps are known: they are fitted twice.
        std::optional<Settings> of_texels;
        if (const double normal_m = finite_or(settings.bias.normal_metres(), 0); normal_m > 0) {
            FittedLight first = light;
            fit_views(first, context_of(settings, 0), int(i), picture_lines);
            of_texels = settings;
            of_texels->bias.normal_unit = OffsetUnit::Texels;
            of_texels->bias.normal = in_texels(first.views, normal_m, resolution);
        }
        const FitContext context = context_of(of_texels ? *of_texels : settings, settings.bias.normal_metres());
        fit_views(light, context, int(i), picture_lines);
        if (light.range_m > 0 && !reaches_anything(light, shape))
            add_note(light,
                     fmt::format("light.range: nothing lies within {} of light {}", metres_text(light.range_m), i));
        light.dark = why_dark(light, scene);
        if (!s.cast)
            light.reason = "light.cast is off";
        else if (!shape.triangles)
            light.reason =
                scene.hidden.empty() ? "the scene has no triangles" : "all objects with triangles are hidden";
        else if (!shape.casters)
            light.reason = "no object casts";
        else if (!shape.receivers)
            light.reason = "no object receives shadows";
        light.shadowed = light.reason.empty();
        if (const Source& source = source_of(settings, i); light.shadowed && !source.needs.map)
            light.reason = fmt::format("light.source is {}, which needs no map", source.key);
        light.casts = light.reason.empty();
        if (!light.casts) continue;
        if (!light.views.front().clamps_near) light.clipped_casters = count_near_clipped_casters(shape, light.views);
        light.limits = map_limits(shape, light.views, settings.map.format, resolution);
        if (!fit_reads_camera(settings, int(i))) light.empty = why_empty(light, shape, context);
        for (std::string& text : map_limit_notes(light.limits, int(i))) add_note(light, std::move(text));
    }
    return lights;
}

std::vector<FittedLight> fit_lights(const Scene& scene, const Settings& settings, const Camera* camera) {
    return fit_maps(place_lights(scene, settings), scene, settings, camera);
}

}  // namespace si
