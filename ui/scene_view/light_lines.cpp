#include "ui/scene_view/light_lines.h"

#include <array>
#include <cmath>

namespace si {

std::vector<Segment> frustum_edges(const LightView& view) {
    const auto corner = [&](int i, double z) {
        const double half = view.half_width * (view.curve.perspective ? z : 1.0);
        return view.eye + view.axes * glm::dvec3(i & 1 ? half : -half, i & 2 ? half : -half, -z);
    };
    constexpr std::array<std::pair<int, int>, 4> sides{{{0, 1}, {1, 3}, {3, 2}, {2, 0}}};
    std::vector<Segment> edges;
    for (const auto& [a, b] : sides) {
        edges.push_back({corner(a, view.curve.near), corner(b, view.curve.near), false});
        edges.push_back({corner(a, view.curve.far), corner(b, view.curve.far), true});
        edges.push_back({corner(a, view.curve.near), corner(a, view.curve.far), false});
    }
    return edges;
}

std::optional<std::pair<glm::dvec2, glm::dvec2>> project_segment(const Camera& camera, glm::dvec3 from, glm::dvec3 to,
                                                                 int width, int height) {
    if (!camera.orthographic) {
        // Clip at a plane well before the camera's own near plane: lines need no depth precision, only w > 0.
        const double plane = std::max(1e-9, camera.focus * 1e-4);
        const double a = -glm::dot(from - camera.eye, camera.axes[2]), b = -glm::dot(to - camera.eye, camera.axes[2]);
        if (a < plane && b < plane) return {};
        if (a < plane) from += (to - from) * ((plane - a) / (b - a));
        if (b < plane) to += (from - to) * ((plane - b) / (a - b));
    }
    const glm::dvec4 p = camera.project(from, width, height), q = camera.project(to, width, height);
    if (!(p.w > 0) || !(q.w > 0)) return {};
    const glm::dvec2 first(p), second(q);
    for (const double v : {first.x, first.y, second.x, second.y})
        if (!std::isfinite(v)) return {};
    return std::pair{first, second};
}

}  // namespace si
