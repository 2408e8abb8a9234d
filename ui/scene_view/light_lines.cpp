#include "ui/scene_view/light_lines.h"

#include <array>
#include <cmath>

namespace si {

std::vector<Segment> frustum_edges(const LightView& view) {
    const auto corner = [&](int i, bool far) {
        const glm::dvec2 uv(i & 1, i >> 1);
        const DepthCurve curve = view.curve.curve_at_row(uv.y);
        return view.position_ws(uv, far ? curve.far : curve.near);
    };
    constexpr std::array<std::pair<int, int>, 4> sides{{{0, 1}, {1, 3}, {3, 2}, {2, 0}}};
    std::vector<Segment> edges;
    for (const auto& [a, b] : sides) {
        edges.push_back({corner(a, false), corner(b, false), false});
        edges.push_back({corner(a, true), corner(b, true), true});
        edges.push_back({corner(a, false), corner(a, true), false});
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
