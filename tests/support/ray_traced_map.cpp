#include "tests/support/ray_traced_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace si::test {

std::optional<double> first_hit(const std::vector<TestBox>& boxes, const glm::dvec3& from, const glm::dvec3& to) {
    std::optional<double> out;
    for (const TestBox& box : boxes) {
        double enter = 0, leave = 1;
        for (int i = 0; i < 3; ++i) {
            const double a = (box.lo[i] - from[i]) / (to[i] - from[i]), b = (box.hi[i] - from[i]) / (to[i] - from[i]);
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        if (enter < leave && enter > 0 && (!out || enter < *out)) out = enter;
    }
    return out;
}

std::vector<TestBox> unequal_boxes(const glm::dvec3& c) {
    return {{c + glm::dvec3(-12, -1, -12), c + glm::dvec3(12, 0, 12)},
            {c + glm::dvec3(-5, 0, -4), c + glm::dvec3(-2, 3, -1)},
            {c + glm::dvec3(1, 0, -3), c + glm::dvec3(2, 5, -2)},
            {c + glm::dvec3(2.5, 0, 1), c + glm::dvec3(6, 1, 4)},
            {c + glm::dvec3(-3, 2, 2), c + glm::dvec3(0, 2.5, 3)}};
}

FirstCasters casters_of(std::vector<TestBox> boxes) {
    return [boxes = std::move(boxes)](std::span<const MapRay> rays) {
        std::vector<double> out;
        for (const MapRay& ray : rays) {
            const auto hit = first_hit(boxes, ray.from_ws, ray.to_ws);
            out.push_back(hit ? *hit * glm::distance(ray.from_ws, ray.to_ws)
                              : std::numeric_limits<double>::quiet_NaN());
        }
        return out;
    };
}

FloatImage traced_map(const TracedMap& map, const std::vector<TestBox>& boxes) {
    const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
    const double near_ndc = map.depth.zero_to_one ? map.depth.near_depth() : 2 * map.depth.near_depth() - 1;
    const double far_ndc = map.depth.zero_to_one ? map.depth.far_depth() : 2 * map.depth.far_depth() - 1;
    const auto at = [&](double x, double y, double z) {
        const glm::dvec4 h = world_from_clip * glm::dvec4(x, y, z, 1);
        return glm::dvec3(h) / h.w;
    };
    FloatImage out{map.width, map.height, 1, {}};
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const double x = 2 * (column + 0.5) / map.width - 1, y = 1 - 2 * (row + 0.5) / map.height;
            const glm::dvec3 from = at(x, y, near_ndc), to = at(x, y, far_ndc);
            const auto hit = first_hit(boxes, from, to);
            const glm::dvec3 point = hit ? from + *hit * (to - from) : to;
            const double along = glm::dot(point - map.eye, map.forward), away = glm::distance(point, map.eye);
            double value = 0;
            switch (map.stored) {
                case BundleStored::Linear:
                    value = (along - map.near) / (map.far - map.near);
                    break;
                case BundleStored::AxisMetres:
                    value = along;
                    break;
                case BundleStored::DistanceMetres:
                    value = away;
                    break;
                case BundleStored::DistanceShare:
                    value = away / map.far;
                    break;
                default: {
                    const glm::dvec4 h = map.clip_from_world * glm::dvec4(point, 1);
                    value = map.depth.zero_to_one ? h.z / h.w : 0.5 * h.z / h.w + 0.5;
                    if (!hit) value = map.depth.far_depth();
                }
            }
            const double most = std::pow(2.0, map.bits) - 1;
            out.data.push_back(float(map.bits ? std::round(value * most) / most : value));
        }
    return out;
}

FloatImage upside_down(const FloatImage& image) {
    FloatImage out = image;
    const auto across = std::ptrdiff_t(image.width) * image.channels;
    for (int row = 0; row < image.height; ++row)
        std::copy_n(image.data.begin() + row * across, across, out.data.begin() + (image.height - 1 - row) * across);
    return out;
}

}  // namespace si::test
