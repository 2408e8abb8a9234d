#include "ui/scene_view/frustum_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/view/bounds/convex.h"
#include "ui/widgets/clip.h"

namespace si {
namespace {

constexpr double kFarInFocus = 20;
constexpr double kBeforeLight = 1e-3;  // share of a perspective map's near distance, at which lines are clipped

/// Returns the twelve edges of a frustum. @param corner a function that returns a corner: bits 0 and 1 of its first
/// argument choose the side, the second argument the far plane
std::vector<Segment> edges_between(const auto& corner) {
    constexpr std::array<std::pair<int, int>, 4> sides{{{0, 1}, {1, 3}, {3, 2}, {2, 0}}};
    std::vector<Segment> edges;
    for (const auto& [a, b] : sides) {
        edges.push_back({corner(a, false), corner(b, false), false});
        edges.push_back({corner(a, true), corner(b, true), true});
        edges.push_back({corner(a, false), corner(a, true), false});
    }
    return edges;
}

}  // namespace

std::vector<Segment> camera_edges(const Camera& camera) {
    const double near = camera.curve.near, far = std::max(std::min(camera.curve.far, kFarInFocus * camera.focus), near);
    return edges_between([&](int i, bool is_far) {
        const double z = is_far ? far : near;
        const double half = camera.orthographic ? 0.5 * camera.height : z * std::tan(0.5 * camera.fov_y_rad);
        return camera.eye +
               camera.axes * glm::dvec3(i & 1 ? half * camera.aspect : -half * camera.aspect, i & 2 ? half : -half, -z);
    });
}

std::vector<Segment> frustum_edges(const LightView& view) {
    return edges_between([&](int i, bool far) {
        const glm::dvec2 uv(i & 1, i >> 1);
        const DepthCurve curve = view.curve.curve_at_row(uv.y);
        return view.position_ws(uv, far ? curve.far : curve.near);
    });
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

std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_outline_in_map(const Camera& camera, const LightView& view) {
    std::vector<std::pair<glm::dvec2, glm::dvec2>> lines;
    const glm::dmat3 to_view = glm::transpose(view.axes);
    // Lines are clipped at w near 0: at the light, or where a warped map reaches infinity.
    const double least = view.warped() ? 1e-6 : kBeforeLight * view.curve.near;
    const auto w_of = [&](const glm::dvec3& v) { return (view.projection * glm::dvec4(v, 1)).w; };
    const auto in_map = [&](const glm::dvec3& v) {
        const glm::dvec4 h = view.projection * glm::dvec4(v, 1);
        return 0.5 + 0.5 * glm::dvec2(h) / h.w;
    };
    for (const auto& [from, to, far] : camera_edges(camera)) {
        glm::dvec3 a = to_view * (from - view.eye), b = to_view * (to - view.eye);
        if (view.curve.perspective || view.warped()) {
            const double at_a = w_of(a), at_b = w_of(b);
            if (at_a < least && at_b < least) continue;
            if (at_a < least) a += (b - a) * ((least - at_a) / (at_b - at_a));
            if (at_b < least) b += (a - b) * ((least - at_b) / (at_a - at_b));
        }
        if (const auto inside = clip_to_box(in_map(a), in_map(b), glm::dvec2(0), glm::dvec2(1)))
            lines.push_back(*inside);
    }
    return lines;
}

std::vector<std::pair<glm::dvec2, glm::dvec2>> camera_region_in_map(const Camera& camera, const LightView& view) {
    if (view.curve.perspective || view.warped()) return camera_outline_in_map(camera, view);
    std::vector<glm::dvec2> points;
    const glm::dmat3 to_view = glm::transpose(view.axes);
    for (const auto& [from, to, far] : camera_edges(camera))
        for (const glm::dvec3& p : {from, to})
            points.push_back(0.5 + 0.5 * glm::dvec2(view.projection * glm::dvec4(to_view * (p - view.eye), 1)));
    // The outline is closed along the map's rim; else a region beyond it would leave stray lines.
    Polygon region;
    for (const glm::dvec2& p : convex_hull(std::move(points))) region.emplace_back(p, 0);
    for (const HalfSpace& side :
         {HalfSpace{{1, 0, 0}, 0}, HalfSpace{{-1, 0, 0}, 1}, HalfSpace{{0, 1, 0}, 0}, HalfSpace{{0, -1, 0}, 1}})
        clip_polygon(region, side);
    std::vector<std::pair<glm::dvec2, glm::dvec2>> lines;
    for (std::size_t i = 0; i < region.size(); ++i) lines.emplace_back(region[i], region[(i + 1) % region.size()]);
    return lines;
}

}  // namespace si
