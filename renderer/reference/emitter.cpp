#include "renderer/reference/emitter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/directions.h"
#include "renderer/base/key.h"

namespace si {
namespace {

constexpr double kPi = std::numbers::pi;

/// Maps [-1,1]^2 to the unit disk, preserving areas.
glm::dvec2 on_disk(double x, double y) {
    if (x == 0 && y == 0) return {0, 0};
    const bool wide = std::abs(x) > std::abs(y);
    const double r = wide ? x : y;
    const double angle = wide ? kPi / 4 * (y / x) : kPi / 2 - kPi / 4 * (x / y);
    return r * glm::dvec2(std::cos(angle), std::sin(angle));
}

}  // namespace

Emitter emitter_of(const FittedLight& light, const LightSettings& settings) {
    const double size = std::isfinite(settings.size) ? std::max(settings.size, 0.0) : 0.0;
    return {light.type, light.position, light.to_light, light.cos_cone_outer, light.range_m, size, light.shadowed};
}

LightSamples::LightSamples(const Emitter& emitter, const glm::dvec3& point_ws, int parts_per_axis, std::uint64_t pixel)
    : emitter_(emitter), point_(point_ws), parts_(parts_per_axis), seed_(splitmix64(pixel)) {
    const glm::dvec3 towards = emitter.direction_from(point_ws, distance_);
    if (emitter.type == LightType::Spot) {
        axes_ = orthonormal_basis(emitter.to_light);
        radius_ = emitter.size;
        return;
    }
    axes_ = orthonormal_basis(towards);
    if (emitter.type == LightType::Directional) {
        const double half = 0.5 * std::min(emitter.size, 90.0) * kPi / 180;
        one_minus_cos_ = 2 * std::sin(half) * std::sin(half);
    } else {
        // Inside the sphere, half of all directions.
        const double sine = distance_ > emitter.size ? emitter.size / distance_ : 1.0;
        one_minus_cos_ = sine * sine / (1 + std::sqrt(std::max(1 - sine * sine, 0.0)));
    }
}

LightRay LightSamples::ray(int x, int y) const {
    const std::uint64_t bits = splitmix64(seed_ + std::uint64_t(y) * 0x10001 + std::uint64_t(x));
    const double jitter_x = double(bits >> 32) * 0x1p-32, jitter_y = double(bits & 0xffffffffu) * 0x1p-32;
    const glm::dvec2 disk = on_disk(2 * (x + jitter_x) / parts_ - 1, 2 * (y + jitter_y) / parts_ - 1);
    if (emitter_.type == LightType::Spot)
        return {emitter_.position_ws + radius_ * (disk.x * axes_[0] + disk.y * axes_[1]) - point_, 1};
    // Lambert's azimuthal equal-area projection, onto the cap of directions.
    const double h = one_minus_cos_ * glm::dot(disk, disk);
    const glm::dvec2 across = disk * std::sqrt(one_minus_cos_ * (2 - h));
    const glm::dvec3 direction = axes_ * glm::dvec3(across, 1 - h);
    if (emitter_.type == LightType::Directional) return {direction, std::numeric_limits<double>::infinity()};
    // Distance to the sphere's near side.
    const double along = distance_ * (1 - h), r2 = emitter_.size * emitter_.size;
    const double beside2 = std::max(distance_ * distance_ - along * along, 0.0);
    const double chord = std::sqrt(std::max(r2 - beside2, 0.0));
    const double length = distance_ > emitter_.size ? along - chord : along + chord;
    return {direction * std::max(length, 1e-12 * emitter_.size), 1};
}

}  // namespace si
