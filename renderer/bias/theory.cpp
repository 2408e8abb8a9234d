#include "renderer/bias/theory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/projection/projection.h"
#include "renderer/settings/map_storage.h"
#include "shaders/shared/facing.h"

namespace si {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

}  // namespace

ReceiverPlane receiver_plane(const LightView& view, const glm::dvec3& point_ws, const glm::dvec3& normal_ws) {
    // Relative to the point, the plane is (n, 0) and nothing cancels.
    const glm::dmat4 t = uvd_from_clip(view.curve.convention) * view.clip_from_relative(point_ws);
    const glm::dvec4 plane = glm::transpose(glm::inverse(t)) * glm::dvec4(normal_ws, 0.0);
    ReceiverPlane r;
    r.w = t[3][3];
    r.uvd = glm::dvec3(t[3]) / r.w;
    const glm::dvec3 to_light = view.curve.perspective ? view.eye - point_ws : view.axes[2];
    const double cosine = glm::dot(normal_ws, to_light) / (glm::length(normal_ws) * glm::length(to_light));
    const bool edge_on = !(std::abs(cosine) > shared::FACES_AWAY_COSINE);
    const auto component = [&](double across) {
        return !edge_on ? -across / plane.z : across == 0 ? 0 : std::copysign(kUnbounded, -across / plane.z);
    };
    r.gradient = {component(plane.x), component(plane.y)};
    if (edge_on && r.gradient == glm::dvec2(0)) r.gradient = glm::dvec2(kUnbounded);  // the normal is 0
    return r;
}

double depth_quantum(MapFormat format, double depth) {
    if (format == MapFormat::D16) return 1.0 / ((1 << 16) - 1);
    if (format == MapFormat::D24) return 1.0 / ((1 << 24) - 1);
    const float d = std::clamp(float(depth), 0.0f, 1.0f);
    if (d == 0) return 0x1p-149;
    return std::ldexp(1.0, std::max(std::ilogb(d), -126) - 23);
}

double depth_quantum(MapFormat format, const DepthCurve& curve, double depth) {
    if (!holds_distances(format)) return depth_quantum(format, depth);
    const MapFormat kept = format == MapFormat::Linear16 ? MapFormat::D16 : MapFormat::D32F;
    if (!curve.perspective) return depth_quantum(kept, depth);
    const double z = curve.distance(depth), range = curve.far - curve.near;
    const double share = (curve.convention.reversed ? curve.far - z : z - curve.near) / range;
    // Shaders also convert w to a distance and back to a depth, in single precision.
    return depth_quantum(kept, share) * range * curve.slope(z) + 4 * depth_quantum(MapFormat::D32F, depth) +
           4 * 0x1p-23 * z * curve.slope(z);
}

LeastBias least_bias(const glm::dvec2& gradient, double kappa_texels, MapSize size, double quantum, int subpixel_bits,
                     double rounding) {
    const glm::dvec2 shape = double(size.longest()) / size.texels();
    const double per_texel = (std::abs(gradient.x) * shape.x + std::abs(gradient.y) * shape.y) / size.longest();
    LeastBias b;
    b.kernel = kappa_texels * per_texel;
    b.quantum = quantum;
    b.rounding = rounding;
    b.snapping = subpixel_bits > 0 ? std::ldexp(per_texel, -(subpixel_bits + 1)) : 0;
    return b;
}

double rounding_bias(const LightView& view, const glm::dvec3& point_ws, double extent_m) {
    const double z = glm::dot(view.eye - point_ws, view.axes[2]);
    const DepthCurve curve = view.ray_depth_curve(point_ws);
    return 4 * 0x1p-23 *
           std::max(extent_m * (curve.slope(z) + view.relative_dw_per_m(point_ws) * curve.depth(z)), curve.depth(z));
}

double uv_rounding_bias(const LightView& view, const glm::dvec3& point_ws, const glm::dvec2& gradient, double extent_m,
                        MapSize size) {
    const double across_m = view.texel_size_at(point_ws, size).shortest * size.shortest();
    return 4 * 0x1p-23 * extent_m * (1 / across_m + view.relative_dw_per_m(point_ws)) *
           (std::abs(gradient.x) + std::abs(gradient.y));
}

double least_normal_offset(const LightView& view, const glm::dvec3& point_ws, const glm::dvec3& normal_ws,
                           double b_min) {
    const glm::dvec3 relative = point_ws - view.eye;
    const double z = -glm::dot(relative, view.axes[2]);
    // Ray to the point, one metre long along the view's axis.
    const glm::dvec3 ray = view.curve.perspective ? relative / z : -view.axes[2];
    return view.ray_depth_curve(point_ws).metres_towards_light(z, b_min) *
           std::abs(glm::dot(glm::normalize(normal_ws), ray));
}

double contact_gap(double bias_m, double theta_rad) {
    return bias_m * std::sin(theta_rad);
}

}  // namespace si
