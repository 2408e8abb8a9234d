// Fits of a single map of a directional or spot light, orthographic or perspective.
#include <fmt/format.h>

#include <cmath>

#include "renderer/base/directions.h"
#include "renderer/base/finite.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/fits.h"
#include "renderer/view/cascades/cascades.h"
#include "renderer/view/fits/fit_context.h"
#include "renderer/view/fits/near_far.h"
#include "renderer/view/fits/region.h"

namespace si {
namespace {

/// Smallest manual half extent without a note, as a share of the scene's radius.
constexpr double kMinManualShare = 1e-6;

/// Returns the manual half extent in metres, or 0.
double manual_half_extent(const LightSettings& s) {
    return s.fit == LightFit::Manual ? positive_or(s.extent, 0) : 0;
}

/// Fits an orthographic map over all boxes (`half` 0), or with a given half extent about the view's axis.
void fit_orthographic(FittedLight& light, LightView view, const FitContext& c, double half, bool in_front_only) {
    const double manual = manual_half_extent(c.settings);
    if (manual > 0) half = manual;
    if (manual > 0 && manual < kMinManualShare * c.shape.radius)
        add_note(light, fmt::format("light.extent ({}) is below a millionth of the scene ({} across): the map holds "
                                    "next to nothing; raise it, or set 0 for the fit's own",
                                    metres_text(manual), metres_text(2 * c.shape.radius)));
    ViewExtent e = extent_in_view(c.shape, view);
    if (half <= 0) {
        const glm::dvec3 middle = 0.5 * (e.lo + e.hi);
        view.eye += view.axes * glm::dvec3(middle.x, middle.y, 0);
        half = half_extent_with_margin(0.5 * std::max(e.hi.x - e.lo.x, e.hi.y - e.lo.y), c.shape.radius, c.resolution);
    }
    view.set_half_extents(glm::dvec2(half));
    if (in_front_only) {
        e.lo.z = std::clamp(e.lo.z, 0.0, c.reach_m);
        e.hi.z = std::clamp(e.hi.z, e.lo.z, c.reach_m);
    }
    set_parallel_range(view, c, {e.lo.z, e.hi.z});
    if (in_front_only)
        view.curve.near = std::max(view.curve.near, std::min(e.lo.z, 0.0) - kDepthMargin * (e.hi.z - e.lo.z));
    add_finished_view(light, view, c, 1);
}

/// Fits a perspective map with tangent `tan_half`; 0 chooses the tangent so that every box is inside.
void fit_perspective(FittedLight& light, LightView view, const FitContext& c, double tan_half) {
    if (tan_half <= 0) {
        double tangent = kMinHalfAngle;
        for (std::size_t i = 0; i < c.shape.boxes.size(); ++i)
            for (const glm::dvec3& p : c.shape.boxes[i]) {
                if (i == c.shape.ground) break;
                const glm::dvec3 v = glm::transpose(view.axes) * (p - view.eye);
                const double aside = std::max(std::abs(v.x), std::abs(v.y));
                tangent = std::max(tangent, -v.z > 0 ? aside / -v.z : std::tan(kMaxHalfAngle));
            }
        const double limit = std::tan(kMaxHalfAngle);
        tan_half = std::min(half_extent_with_margin(tangent, tangent, c.resolution), limit);
        if (tan_half == limit) add_note(light, "the light stands in the scene: its map covers 172 degrees only");
    }
    view.set_half_extents(glm::dvec2(tan_half));
    set_perspective_range(view, c);
    add_finished_view(light, view, c, view.curve.far);
}

/// Returns the depth range along the light of visible receivers, where the fit depends on it.
std::optional<DepthSpan> seen_receivers(const LightView& view, const FitContext& c) {
    const bool asked = c.settings.near_far == NearFar::Casters || c.settings.near_far == NearFar::Pancaking;
    if (!asked || !c.camera || !fit_row(c.settings.fit).reads_camera) return std::nullopt;
    const DepthSpan depths = c.seen_m.value_or(DepthSpan{c.camera->curve.near, c.camera->curve.far});
    const CameraSlice slice(*c.camera, depths.from_m, depths.to_m);
    ViewExtent seen;
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i)
        if (c.shape.box_receives[i]) seen.add(extent_in_view(slice.visible_points(c.shape, i), view));
    if (!(seen.lo.z <= seen.hi.z)) return std::nullopt;
    return DepthSpan{seen.lo.z, seen.hi.z};
}

/// Fits a map to a region: about the region's middle, or in perspective about the light's axis.
void fit_region(FittedLight& light, LightView view, const FitContext& c, const MapRegion& region) {
    light.closed = true;
    if (view.curve.perspective) {
        const glm::dvec2 aside = glm::max(glm::abs(region.lo), glm::abs(region.hi));
        const double tangent = std::max({aside.x, aside.y, kMinHalfAngle});
        return fit_perspective(light, view, c,
                               std::min(half_extent_with_margin(tangent, tangent, c.resolution, c.margin_texels),
                                        half_extent_with_margin(view.half_extent(), 0, c.resolution)));
    }
    const glm::dvec2 size = region.hi - region.lo;
    view.eye += view.axes * glm::dvec3(0.5 * (region.lo + region.hi), 0);
    // Floats count from map_origin, in the scene's main part: they are finer there than the whole scene's size tells.
    const glm::dvec2 aside(glm::transpose(view.axes) * (view.eye - light.map_origin));
    const double scale =
        c.shape.main_radius < c.shape.radius ? std::max(c.shape.main_radius, glm::length(aside)) : c.shape.radius;
    view.set_half_extents(
        glm::dvec2(half_extent_with_margin(0.5 * std::max(size.x, size.y), scale, c.resolution, c.margin_texels)));
    ViewExtent held;
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) held.add(extent_inside_view(c.shape, i, view));
    if (!(held.lo.z <= held.hi.z)) held = extent_in_view(c.shape, view);  // too far away for double precision
    const std::optional<DepthSpan> receivers = seen_receivers(view, c);
    set_parallel_range(view, c, {held.lo.z, held.hi.z}, receivers ? &*receivers : nullptr);
    add_finished_view(light, view, c, 1);
}

/// Returns the function that finds the region of a fit, for directional lights without perspective and single-map spot
/// lights. Null: the map covers the whole scene.
FitFunction fit_function(LightFit fit) {
    if (fit == LightFit::Casters) return fit_casters;
    return fit == LightFit::View ? fit_view : nullptr;
}

/// Returns the region of a fit. A ground widens the region only by shadows on the ground that stick out of the model's
/// own region. Empty where the model alone has no region, since the map of the whole scene then contains everything.
std::optional<MapRegion> region_of(const FitInput& in, FitFunction find) {
    if (!in.shape.ground) return find(in);
    FitInput part = in;
    part.receiver_filter = ReceiverFilter::Model;
    std::optional<MapRegion> region = find(part);
    if (!region) return std::nullopt;
    part.receiver_filter = ReceiverFilter::Ground;
    const std::optional<MapRegion> ground = find(part);
    if (!ground) return region;
    ViewExtent all{glm::dvec3(region->lo, 0), glm::dvec3(region->hi, 0)};
    widen_for_ground_shadow(all, {glm::dvec3(ground->lo, 0), glm::dvec3(ground->hi, 0)});
    return MapRegion{glm::dvec2(all.lo), glm::dvec2(all.hi)};
}

}  // namespace

void fit_one_view(FittedLight& light, const FitContext& c) {
    LightView view;
    view.axes = orthonormal_basis(light.to_light);
    view.eye = light.position;
    const bool directional = light.type == LightType::Directional;
    // The circle of the cone touches the map's sides, so only kernels at its rim need the margin.
    double tangent = directional ? 0 : half_extent_with_margin(std::tan(light.half_cone_rad), 0, c.resolution);
    const LightProjection projection = c.settings.projection;
    const bool perspective =
        directional ? projection == LightProjection::Perspective : projection != LightProjection::Orthographic;
    if (perspective != directional) {  // otherwise the map's rays differ from the light's
        view.curve.perspective = perspective;
        view.set_half_extents(glm::dvec2(directional ? 1 : std::tan(light.half_cone_rad)));
        const FitInput input{c.scene, c.shape, view, c.reach_m, c.camera, c.seen_m, ReceiverFilter::All};
        const FitFunction find = fit_function(c.settings.fit);
        if (const auto region = find ? region_of(input, find) : std::nullopt)
            return fit_region(light, view, c, *region);
    }
    if (perspective) {
        const double by_hand = directional ? 0 : manual_half_extent(c.settings) / light.distance_m;
        if (by_hand > 0) tangent = std::min(tangent, std::max(by_hand, kMinHalfAngle));
        fit_perspective(light, view, c, tangent);
    } else {
        fit_orthographic(light, view, c, tangent * light.distance_m, !directional);
    }
}

}  // namespace si
