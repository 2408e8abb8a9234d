#include "renderer/bias/account.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/view/kernel_reach.h"

namespace si {
namespace {

/// The largest coordinate that shaders of this pixel compute with, in metres: across the map, or from what the picture
/// and the map count positions from.
double extent_m(const FittedLight& light, const LightView& view, const LightReceiver& r, int resolution,
                const SurfacePoint& p) {
    const glm::dvec3 farthest =
        glm::max(glm::abs(p.position_ws - p.origin_ws), glm::abs(p.position_ws - light.map_origin));
    const double half_map = 0.5 * view.texel_size(view.curve.perspective ? r.clip.w : 1.0, resolution) * resolution;
    return std::max({half_map, farthest.x, farthest.y, farthest.z});
}

double raster_offset(const BiasSettings& bias, const PolygonOffset& driver, const glm::dvec2& per_texel,
                     double quantum) {
    const double by_slope =
        bias.raster_slope != 0 ? bias.raster_slope * driver.slope(per_texel) : 0;  // edge-on it is infinite
    const double offset = by_slope + bias.raster_units * driver.unit(quantum);
    return bias.raster_clamp > 0 ? std::min(offset, bias.raster_clamp) : offset;
}

}  // namespace

double BiasAccount::contact_gap_m() const {
    return contact_gap(amount(clears()).metres, theta_rad);
}

BiasAccount bias_account(const FittedLight& light, const Settings& settings, int resolution, const SurfacePoint& p,
                         const RasterTraits& driver) {
    const BiasSettings& bias = settings.bias;
    BiasAccount a;
    a.receiver = light_receiver(light, bias, resolution, p.position_ws, p.geometric, p.bias_normal);
    const LightReceiver& r = a.receiver;
    const LightView& view = light.views[r.view];
    a.plane = receiver_plane(view, p.position_ws, p.geometric);
    a.theta_rad = std::acos(std::clamp(r.n_dot_l, -1.0, 1.0));
    a.curve = view.curve;
    const double quantum = depth_quantum(MapFormat(settings.map.format), r.uvd.z);
    const double kappa = reach_under(settings, light, resolution).bias;
    a.least = least_bias(a.plane.gradient, kappa, resolution, quantum, driver.subpixel_bits,
                         rounding_bias(view, p.position_ws, extent_m(light, view, r, resolution, p)));
    const double slope = bias.slope * (1 - std::clamp(glm::dot(p.bias_normal, r.to_light), 0.0, 1.0));
    (slope > bias.constant ? a.slope : a.constant) = r.bias_depth;
    const double away = view.curve.convention.reversed ? -1 : 1;
    if (bias.normal != 0)
        a.normal = a.plane.edge_on() ? std::numeric_limits<double>::infinity()
                                     : away * (a.plane.at(glm::dvec2(r.tap)) - r.tap.z);
    a.raster = raster_offset(bias, driver.offset[std::size_t(settings.map.format)],
                             a.plane.gradient / double(resolution), quantum);
    a.lifts = away * (r.uvd.z - r.compared) + a.raster;
    return a;
}

}  // namespace si
