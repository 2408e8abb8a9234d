#include "renderer/view/culling/box_culling.h"

namespace si {
namespace {

constexpr std::size_t kNearPlane = 4, kFarPlane = 5, kWidth = 6;

/// Largest relative error of a product of floats.
constexpr double kFloatSlack = 4e-6;

}  // namespace

BoxCuller::BoxCuller(const glm::dmat4& m, const glm::dvec3& origin, const DepthConvention& convention, bool clamps_near,
                     int resolution)
    : origin_(origin), clamps_near_(clamps_near), texel_(2.0 / resolution) {
    const auto row = [&](int r) { return glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]); };
    const glm::dvec4 x = row(0), y = row(1), z = row(2), w = row(3);
    const glm::dvec4 low = convention.zero_to_one ? z : w + z, high = w - z;
    planes_ = {w + x, w - x, w + y, w - y, convention.reversed ? high : low, convention.reversed ? low : high, w};
}

BoxCuller::Span BoxCuller::span_of(std::size_t plane, const SkewBox& box) const {
    const glm::dvec4& p = planes_[plane];
    const glm::dvec3 normal(p), centre = box.centre - origin_;
    const double middle = glm::dot(normal, centre) + p.w;
    double half = 0;
    for (int i = 0; i < 3; ++i) half += std::abs(glm::dot(normal, box.half[i]));
    const double terms = glm::dot(glm::abs(normal), glm::abs(centre)) + std::abs(p.w) + half;
    return {middle - half, middle + half, kFloatSlack * terms};
}

bool BoxCuller::is_outside(const SkewBox& box) const {
    const Span w = span_of(kWidth, box);
    if (w.max < -w.slack) return true;
    for (std::size_t i = 0; i <= kFarPlane; ++i) {
        // A map with clamped depths draws casters outside its depth range on its near or far plane.
        if (clamps_near_ && i >= kNearPlane) break;
        const Span span = span_of(i, box);
        if (span.max < -span.slack - texel_ * std::max(w.max, 0.0)) return true;
    }
    return false;
}

bool BoxCuller::is_in_front(const SkewBox& box) const {
    const Span w = span_of(kWidth, box), near = span_of(kNearPlane, box);
    return w.min > w.slack && (clamps_near_ || near.min > near.slack);
}

}  // namespace si
