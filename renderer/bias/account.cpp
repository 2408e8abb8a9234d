#include "renderer/bias/account.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/projection/projection.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/depth_compare.h"
#include "renderer/settings/map_storage.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Returns the largest coordinate in metres that shaders of this pixel compute with: the map's extent, or the distance
/// from the origins of picture and map.
double extent_m(const FittedLight& light, const LightReceiver& r, MapSize size, const SurfacePoint& p) {
    const glm::dvec3 farthest =
        glm::max(glm::abs(p.position_ws - p.origin_ws), glm::abs(p.position_ws - light.map_origin));
    const double half_map = 0.5 * r.texel_m * size.longest();
    return std::max({half_map, farthest.x, farthest.y, farthest.z});
}

/// Returns the greatest depth of a point's triangle within the map's depth range.
double greatest_depth(const LightView& view, const SurfacePoint& p, double own) {
    if (!p.corners_ws) return own;
    double greatest = 0;
    for (const glm::dvec3& corner : *p.corners_ws) {
        const glm::dvec4 clip = view.clip_position(corner);
        const DepthConvention& convention = view.curve.convention;
        const bool cut = view.curve.perspective && clip.w <= view.curve.near;
        const double depth = cut ? 1 - convention.far_depth() : uvd_from_ndc(convention, glm::dvec3(clip) / clip.w).z;
        greatest = std::max(greatest, std::clamp(depth, 0.0, 1.0));
    }
    return greatest;
}

}  // namespace

double BiasBreakdown::contact_gap_m() const {
    return contact_gap(amount(equivalent_depth()).metres, theta_rad) + moved_aside_m;
}

double BiasBreakdown::offset_shift_m() const {
    constexpr double kLeastCosine = 1e-3;
    const double across_m = glm::length(glm::cross(receiver.normal_offset_ws, receiver.to_light));
    return across_m / std::max(std::cos(theta_rad), kLeastCosine);
}

double BiasBreakdown::compared_depth_at(const glm::dvec2& centre) const {
    if (!per_texel || plane.edge_on()) return receiver.compared;
    const glm::dvec2 aside = centre - glm::dvec2(receiver.tap);
    double moved = std::clamp(glm::dot(plane.gradient, aside), -max_texel_shift, max_texel_shift);
    if (remainder_per_texel > 0) {
        const double away = curve.convention.reversed ? -1 : 1;
        moved = away * (std::min(away * moved, 0.0) - remainder_per_texel * glm::length(aside * map_size.texels()));
    }
    const double depth = receiver.compared + moved;
    // The map may be empty where the plane continues beyond the far plane.
    return curve.convention.reversed ? std::max(depth, std::min(receiver.compared, 0.0))
                                     : std::min(depth, std::max(receiver.compared, 1.0));
}

BiasBreakdown bias_breakdown(const FittedLight& light, const Settings& settings, MapSize size, const SurfacePoint& p,
                             const RasterTraits& driver, std::optional<double> kernel_reach_texels) {
    const BiasSettings& bias = settings.bias;
    const Bias& row = bias_of(settings);
    BiasBreakdown a;
    a.map_size = size;
    a.receiver = light_receiver(light, bias, size, p.position_ws, p.geometric, p.bias_normal);
    LightReceiver& r = a.receiver;
    const LightView& view = light.views[r.view];
    a.plane = receiver_plane(view, p.position_ws, p.geometric);
    a.theta_rad = std::acos(std::clamp(r.n_dot_l, -1.0, 1.0));
    a.curve = r.curve;
    BiasInput b{.curve = a.curve,
                .texel_m = r.texel_m,
                .n_dot_l = glm::dot(p.bias_normal, r.to_light),
                .z = r.tap_m,
                .polygon = driver.offset[std::size_t(settings.map.format)],
                .per_texel = a.plane.gradient / size.texels(),
                .quantum = depth_quantum(settings.map.format, view.curve, greatest_depth(view, p, r.uvd.z))};
    const double kappa = kernel_reach_texels ? *kernel_reach_texels : kernel_reach_in_light(settings, light, size).bias;
    const double extent = extent_m(light, r, size, p);
    a.in_map = p.in_map && (view.curve.convention.reversed ? r.uvd.z <= 1 : r.uvd.z >= 0);
    a.least = least_bias(a.plane.gradient, kappa, size, depth_quantum(settings.map.format, view.curve, r.uvd.z),
                         driver.subpixel_bits, rounding_bias(view, p.position_ws, extent));
    a.per_texel = compares_per_texel(settings);
    if (a.per_texel) {
        a.max_texel_shift = bias.plane_clamp > 0 ? bias.plane_clamp * r.texel_m * a.curve.slope(r.own_m) : kNoLimit;
        a.least.kernel = a.least.kernel > a.max_texel_shift ? a.least.kernel - a.max_texel_shift : 0;
        a.least.rounding += uv_rounding_bias(view, p.position_ws, a.plane.gradient, extent, size);
        b.least_per_texel = a.least.without_kernel();
    }
    b.in_map = a.in_map;
    if (!a.in_map) {
        a.least = {};
        b.least_per_texel = 0;
    }
    b.least_common = a.least.total();
    if (a.per_texel && row.remainder) a.remainder_per_texel = row.remainder(b);
    r.bias_depth = row.amount(bias, b);
    r.bias_m = a.curve.metres_towards_light(r.tap_m, r.bias_depth);
    const double away = view.curve.convention.reversed ? -1 : 1;
    r.compared = r.tap.z - away * r.bias_depth;
    BiasSettings level = bias;
    level.slope = 0;
    if (row.gives_needed_bias) {
        BiasSettings nothing = bias;
        nothing.constant = nothing.slope = 0;
        a.bias_of_kind = row.amount(nothing, b);
    }
    const double own = a.plane.edge_on() && row.gives_needed_bias ? 0 : r.bias_depth - a.bias_of_kind;
    (r.bias_depth > row.amount(level, b) ? a.slope : a.constant) = own;
    if (bias.normal != 0)
        a.normal = a.plane.edge_on() ? kNoLimit : away * (a.plane.depth_at(glm::dvec2(r.tap)) - r.tap.z);
    if (bias.normal != 0 && bias.normal_by == OffsetBy::Sideways)
        a.moved_aside_m = r.normal_offset_m * std::clamp(r.n_dot_l, 0.0, 1.0);
    a.raster = offsets_polygons(settings) ? bias_of_stage(BiasStage::Raster).amount(bias, b) : 0;
    if (view.caster_shift.moves()) {
        const double shift_m = view.caster_shift.metres(glm::dot(p.geometric, view.axes[2]));
        a.raster -= a.curve.depth_change_towards_light(r.own_m, -shift_m);
    }
    a.depth_shift = away * (r.uvd.z - r.compared) + a.raster;
    return a;
}

}  // namespace si
