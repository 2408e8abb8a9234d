#include "renderer/bias_account.h"

#include <algorithm>
#include <cmath>

#include "renderer/techniques.h"

namespace si {
namespace {

/// The largest coordinate that shaders of this pixel compute with, in metres: across the map or from the eye.
double extent_m(const LightView& view, const LightReceiver& r, int resolution, const SurfacePoint& p) {
    const glm::dvec3 from_eye = glm::abs(p.position_ws - p.eye_ws);
    const double half_map = 0.5 * view.texel_size(view.curve.perspective ? r.clip.w : 1.0, resolution) * resolution;
    return std::max({half_map, from_eye.x, from_eye.y, from_eye.z});
}

double raster_offset(const BiasSettings& bias, const PolygonOffset& driver, const glm::dvec2& per_texel, double quantum) {
    const double offset = bias.raster_slope * driver.slope(per_texel) + bias.raster_units * driver.unit(quantum);
    return bias.raster_clamp > 0 ? std::min(offset, bias.raster_clamp) : offset;
}

}  // namespace

double BiasAccount::contact_gap_m() const {
    return contact_gap(clears() / depth_per_m, theta_rad);
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
    a.depth_per_m = view.curve.slope(r.own_m);
    const double quantum = depth_quantum(MapFormat(settings.map.format), r.uvd.z);
    const double kappa = filters()[std::size_t(settings.filter.kernel)].reach_texels;
    a.least = least_bias(a.plane.gradient, kappa, resolution, quantum, driver.subpixel_bits,
                         rounding_bias(view, p.position_ws, extent_m(view, r, resolution, p)));
    const double slope = bias.slope * (1 - std::clamp(glm::dot(p.bias_normal, r.to_light), 0.0, 1.0));
    (slope > bias.constant ? a.slope : a.constant) = r.bias_depth;
    const double away = view.curve.convention.reversed ? -1 : 1;
    if (bias.normal != 0) a.normal = away * (a.plane.at(glm::dvec2(r.tap)) - r.tap.z);
    a.raster = raster_offset(bias, driver.offset[std::size_t(settings.map.format)], a.plane.gradient / double(resolution), quantum);
    a.lifts = away * (r.uvd.z - r.compared) + a.raster;
    return a;
}

}  // namespace si
