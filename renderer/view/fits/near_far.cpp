#include "renderer/view/fits/near_far.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/finite.h"
#include "renderer/settings/filters.h"

namespace si {
namespace {

/// Largest cotangent of a sun's height; flatter light casts shadows to the end of the ground.
constexpr double kMaxSunCotangent = 3;
/// Largest reach of kernels at the end of a ground shadow, as a share of the map's width.
constexpr double kMaxGroundKernelOfMap = 0.125;

/// Returns true when a box bounds the near plane.
bool bounds_near(const FitContext& c, std::size_t box) {
    const NearFar choice = c.settings.near_far;
    if (choice == NearFar::Casters) return c.shape.box_casts[box];
    return choice != NearFar::Pancaking || c.shape.box_receives[box];
}

/// Returns true when a box bounds the far plane.
bool bounds_far(const FitContext& c, std::size_t box) {
    const NearFar choice = c.settings.near_far;
    return (choice != NearFar::Casters && choice != NearFar::Pancaking) || c.shape.box_receives[box];
}

}  // namespace

double near_margin_for_bias_m(const FitContext& c, double texel_m, double range_m) {
    const BiasSettings& b = c.all_settings.bias;
    const double amount = std::max({0.0, finite_or(b.constant, 0), finite_or(b.slope, 0)});
    // With a compared depth per texel, taps lie on the slope of the receiver's plane.
    const double aside = 2 * lookup_reach_texels(c.all_settings) * texel_m;
    if (b.unit == BiasUnit::Depth) return aside + range_m * std::min(amount, 0.9) / (1 - std::min(amount, 0.9));
    return aside + (b.unit == BiasUnit::Texels ? amount * texel_m : amount);
}

double lookup_reach_texels(const Settings& s) {
    return reach_of(s).read + std::max(s.bias.normal_texels(), 0.0) + s.map.blur_texels + 1;
}

double whole_reach_texels(const Settings& s) {
    return std::max(6.0, std::ceil(lookup_reach_texels(s)));
}

double ground_kernel_depth_m(const LightView& view, const FitContext& c, double texel_m) {
    if (!c.shape.ground || !c.shape.box_receives[*c.shape.ground]) return 0;
    const double rise = view.axes[2].y;
    if (c.settings.type != LightType::Directional || !(rise > 0)) return 0;
    // Shadows of flatter light run to the end of the ground.
    const double texels = std::min(whole_reach_texels(c.all_settings), kMaxGroundKernelOfMap * c.resolution);
    return texels * texel_m * std::min(std::sqrt(std::max(1 - rise * rise, 0.0)) / rise, kMaxSunCotangent);
}

void set_parallel_range(LightView& view, const FitContext& c, DepthSpan found, const DepthSpan* receivers) {
    view.curve.perspective = false;
    view.curve.convention = c.convention;
    const NearFar choice = c.settings.near_far;
    if (choice == NearFar::Scene) {
        const ViewExtent all = extent_in_view(c.shape, view);
        found = {all.lo.z, all.hi.z};
    } else if (choice == NearFar::Casters || choice == NearFar::Pancaking) {
        ViewExtent near, far;
        for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) {
            if (!bounds_near(c, i) && !bounds_far(c, i)) continue;
            const ViewExtent e = extent_inside_view(c.shape, i, view);
            if (bounds_near(c, i)) near.add(e);
            if (bounds_far(c, i)) far.add(e);
        }
        if (receivers) far.hi.z = receivers->to_m;
        if (receivers && choice == NearFar::Pancaking) near.lo.z = receivers->from_m;
        // A caster behind all receivers, or a scene without casters, bounds nothing.
        if (near.lo.z <= far.hi.z) found = {near.lo.z, far.hi.z};
    }
    const double texel = view.texel_size(1, c.resolution);
    if (const double beyond = ground_kernel_depth_m(view, c, texel); beyond > 0) {
        const double shadow_ends =
            receivers ? receivers->to_m : extent_inside_view(c.shape, *c.shape.ground, view).hi.z;
        found.to_m = std::max(found.to_m, shadow_ends + beyond);
    }
    const double pad = kDepthMargin * (found.to_m - found.from_m);
    view.clamps_near = choice == NearFar::Pancaking;
    const double room = view.clamps_near ? near_margin_for_bias_m(c, texel, found.to_m - found.from_m) : 0;
    view.curve.near = found.from_m - pad - room;
    // A floor facing the light has no depth of its own, so the pad is a texel.
    view.curve.far = found.to_m + pad + (view.clamps_near ? texel : 0);
}

void set_perspective_range(LightView& view, const FitContext& c) {
    const NearFar choice = c.settings.near_far;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (std::size_t i = 0; i < c.shape.boxes.size(); ++i) {
        const ViewExtent e = extent_in_view(c.shape.boxes[i], view);
        const double entry =
            choice == NearFar::Scene ? std::max(e.lo.z, 0.0) : pyramid_entry_m(e, view.cross_section());
        if (!std::isfinite(entry) || e.hi.z <= 0) continue;
        if (bounds_near(c, i)) nearest = std::min(nearest, entry);
        if (bounds_far(c, i)) farthest = std::max(farthest, e.hi.z);
    }
    if (!(farthest > 0)) nearest = farthest = std::max(glm::distance(view.eye, c.shape.centre), c.shape.radius);
    nearest = std::min({nearest, farthest, c.reach_m});
    farthest = std::min(farthest, c.reach_m);
    view.curve.perspective = true;
    view.curve.convention = c.convention;
    view.curve.far = farthest * (1 + kDepthMargin);
    double near = nearest * (1 - kDepthMargin);
    view.clamps_near = choice == NearFar::Pancaking;
    if (view.clamps_near) near -= near_margin_for_bias_m(c, view.texel_size(nearest, c.resolution), farthest - nearest);
    view.curve.near = std::max(near, kMinNearShare * view.curve.far);
}

}  // namespace si
