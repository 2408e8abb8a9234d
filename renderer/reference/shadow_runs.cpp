#include "renderer/reference/shadow_runs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace si {
namespace {

constexpr float kNoEnd = std::numeric_limits<float>::infinity();

/// Rounds to the nearest integer, halves away from zero, as std::lround() does at several times the cost.
int rounded(double value) {
    return int(value + std::copysign(0.5, value));
}

/// Returns true when all views have parallel rays and the axes of the first one.
bool have_axes_of(const std::vector<LightView>& views, const LightView& first) {
    return std::ranges::all_of(views, [&](const LightView& view) {
        return !view.curve.perspective && view.axes[0] == first.axes[0] && view.axes[1] == first.axes[1];
    });
}

/// Returns true when views have the same place and axes.
bool same_frame(const LightView& a, const LightView& b) {
    return a.curve.perspective == b.curve.perspective && a.eye == b.eye && a.axes == b.axes;
}

class Walker {
public:
    Walker(const Reference& reference, const Receivers& receivers, const Camera& camera, const PixelRaster& raster,
           const ReferenceQuery& query)
        : reference_(reference),
          hard_(reference.hard()),
          receivers_(receivers),
          camera_(camera),
          raster_(raster),
          query_(query) {
        find_clearance();
    }

    struct Found {
        float run_m = kNoEnd, edge_m = kNoEnd;
    };

    Found at(int x, int y) const {
        Found found;
        const std::size_t i = index(x, y);
        if (reference_.state[i] != PixelState::Counted || clearance_[i] > kRunReach) return found;
        const Receiver& r = receivers_.pixels[i];
        double distance = 0;
        const glm::dvec3 to_light = query_.emitter.direction_from(r.position_ws, distance);
        const double facing = glm::dot(r.normal_ws, to_light);
        const LightView& view = query_.views[query_.chooser.choose(query_.views, r.position_ws).view];
        for (int a = 0; a < 2; ++a) {
            const glm::dvec3 axis = view.axes[a];
            // Direction within the receiver's plane that changes only one coordinate of the map.
            const glm::dvec3 along = axis - to_light * (glm::dot(r.normal_ws, axis) / facing);
            const glm::dvec2 step = screen_step(r.position_ws, along);
            if (!std::isfinite(step.x) || !std::isfinite(step.y) || (step.x == 0 && step.y == 0)) continue;
            const Side before = walk(x, y, -step, view, axis), behind = walk(x, y, step, view, axis);
            found.edge_m = std::min({found.edge_m, before.change_m, behind.change_m});
            found.run_m =
                std::min({found.run_m, before.change_m + behind.change_m, std::max(before.change_m, before.next_run_m),
                          std::max(behind.change_m, behind.next_run_m)});
        }
        return found;
    }

private:
    const Reference& reference_;
    const FloatImage& hard_;
    const Receivers& receivers_;
    const Camera& camera_;
    const PixelRaster& raster_;
    const ReferenceQuery& query_;
    std::vector<std::uint8_t>
        clearance_;  ///< lower bound in pixels of the distance to a change or to the end of the surface

    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(reference_.width) + std::size_t(x); }
    bool counts(std::size_t i) const { return reference_.state[i] == PixelState::Counted; }
    bool dark(std::size_t i) const { return hard_.data[i] < 0.5f; }
    bool same_surface_right(std::size_t i) const { return receivers_.pixels[i].same_surface_right; }
    bool same_surface_below(std::size_t i) const { return receivers_.pixels[i].same_surface_below; }

    /// Computes chessboard distances by two sweeps (Rosenfeld, Pfaltz, Sequential operations in digital picture
    /// processing, 1966).
    void find_clearance() {
        const int w = reference_.width, h = reference_.height;
        clearance_.assign(reference_.state.size(), std::uint8_t(kRunReach + 1));
        const auto ends = [&](std::size_t i, std::size_t k, bool joined) {
            if (counts(i) && counts(k) && joined && dark(i) == dark(k)) return;
            clearance_[i] = clearance_[k] = 0;
        };
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                const std::size_t i = index(x, y);
                if (x + 1 < w) ends(i, i + 1, same_surface_right(i));
                if (y + 1 < h) ends(i, index(x, y + 1), same_surface_below(i));
            }
        const auto lower = [&](int x, int y, int u, int v) {
            if (u < 0 || v < 0 || u >= w || v >= h) return;
            std::uint8_t& here = clearance_[index(x, y)];
            here = std::min<std::uint8_t>(here, std::uint8_t(clearance_[index(u, v)] + 1));
        };
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                lower(x, y, x - 1, y);
                lower(x, y, x - 1, y - 1);
                lower(x, y, x, y - 1);
                lower(x, y, x + 1, y - 1);
            }
        for (int y = h; y-- > 0;)
            for (int x = w; x-- > 0;) {
                lower(x, y, x + 1, y);
                lower(x, y, x + 1, y + 1);
                lower(x, y, x, y + 1);
                lower(x, y, x - 1, y + 1);
            }
    }

    /// Returns the step in pixels, its longer component 1, that follows a world-space direction from a point.
    glm::dvec2 screen_step(const glm::dvec3& point, const glm::dvec3& along) const {
        const double away = glm::dot(camera_.eye - point, camera_.axes[2]);
        const double pixel_m =
            (camera_.orthographic ? camera_.height : 2 * away * std::tan(0.5 * camera_.fov_y_rad)) / raster_.height;
        const glm::dvec3 moved = point + along * (1e-3 * pixel_m / std::max(glm::length(along), 1e-300));
        const glm::dvec4 a = camera_.project(point, raster_.width, raster_.height);
        const glm::dvec4 b = camera_.project(moved, raster_.width, raster_.height);
        const glm::dvec2 d(b.x - a.x, b.y - a.y);
        const double most = std::max(std::abs(d.x), std::abs(d.y));
        return most > 0 ? d / most : glm::dvec2(0);
    }

    bool joined(int x, int y, int u, int v) const {
        const auto right = [&](int cx, int cy) { return same_surface_right(index(cx, cy)); };
        const auto below = [&](int cx, int cy) { return same_surface_below(index(cx, cy)); };
        const int left = std::min(x, u), top = std::min(y, v);
        if (y == v) return x == u || right(left, y);
        if (x == u) return below(x, top);
        return (right(left, y) && below(u, top)) || (below(x, top) && right(left, v));
    }

    struct Side {
        float change_m = kNoEnd;    ///< distance along the axis to the change, metres
        float next_run_m = kNoEnd;  ///< distance from there to the next change, metres
    };

    Side walk(int x, int y, const glm::dvec2& step, const LightView& view, const glm::dvec3& axis) const {
        const std::size_t start = index(x, y);
        const Receiver& from = receivers_.pixels[start];
        // Distance across the light at the depth of the pixel: for a perspective light by map coordinates.
        const glm::dvec3 origin = view.curve.perspective ? view.eye : from.position_ws;
        const auto across = [&](const glm::dvec3& point) {
            const glm::dvec3 p = point - origin;
            return view.curve.perspective ? glm::dot(p, axis) / -glm::dot(p, view.axes[2]) : glm::dot(p, axis);
        };
        const double here_at = across(from.position_ws);
        const double scale = view.curve.perspective ? -glm::dot(from.position_ws - view.eye, view.axes[2]) : 1.0;
        const auto metres = [&](std::size_t i) {
            return std::abs(across(receivers_.pixels[i].position_ws) - here_at) * scale;
        };
        // The same surface continues behind an occluder.
        const auto same_plane = [&](std::size_t i) {
            const Receiver& r = receivers_.pixels[i];
            const glm::dvec3 d = r.position_ws - from.position_ws;
            return r.object == from.object && std::abs(glm::dot(d, from.normal_ws)) <= 1e-3 * glm::length(d);
        };
        Side side;
        int u = x, v = y, s = x, t = y;
        bool dark_now = dark(start);
        for (int gone = 0, safe; gone < kRunReach;) {
            const int last_s = s, last_t = t;
            safe = std::max(int(clearance_[index(s, t)]) - 1, 1);
            gone = std::min(gone + safe, kRunReach);
            s = x + rounded(step.x * gone);
            t = y + rounded(step.y * gone);
            if (s < 0 || t < 0 || s >= reference_.width || t >= reference_.height) break;
            const std::size_t here = index(s, t), before = index(u, v);
            if (!counts(here)) continue;
            const bool beside = u == last_s && v == last_t && (safe > 1 || joined(u, v, s, t));
            if (!beside && !same_plane(here)) continue;
            if (dark(here) != dark_now) {
                const float at_m = float(0.5 * (metres(before) + metres(here)));
                if (!std::isinf(side.change_m)) {
                    side.next_run_m = at_m - side.change_m;
                    break;
                }
                side.change_m = at_m;
                dark_now = dark(here);
            }
            u = s;
            v = t;
        }
        return side;
    }
};

}  // namespace

bool have_same_runs(const Reference& a, const ReferenceQuery& query_a, const Reference& b,
                    const ReferenceQuery& query_b) {
    const std::vector<LightView>&views_a = query_a.views, &views_b = query_b.views;
    const Emitter &from_a = query_a.emitter, &from_b = query_b.emitter;
    if (from_a.type != from_b.type || from_a.position_ws != from_b.position_ws || from_a.to_light != from_b.to_light)
        return false;
    if (views_a.empty() || views_b.empty()) return views_a.empty() == views_b.empty();
    if (!have_axes_of(views_a, views_a[0]) || !have_axes_of(views_b, views_a[0])) {
        const ViewChooser &by_a = query_a.chooser, &by_b = query_b.chooser;
        const bool by_views = by_a.choice == by_b.choice && by_a.spans.empty() && by_b.spans.empty();
        if (!by_views || !std::ranges::equal(views_a, views_b, same_frame)) return false;
    }
    return a.width == b.width && a.height == b.height && a.state == b.state && a.hard().data == b.hard().data;
}

ShadowRuns shadow_runs(const Reference& reference, const Receivers& receivers, const Camera& camera,
                       const PixelRaster& raster, const ReferenceQuery& query, const Workers& workers) {
    ShadowRuns out;
    const std::vector<float> nothing(reference.state.size(), kNoEnd);
    out.run_m = {reference.width, reference.height, 1, nothing};
    out.edge_m = out.run_m;
    if (query.views.empty()) return out;
    const Walker walker(reference, receivers, camera, raster, query);
    parallel_for_blocks(std::size_t(reference.height), workers, [&](std::size_t y) {
        for (int x = 0; x < reference.width; ++x) {
            const Walker::Found found = walker.at(x, int(y));
            const std::size_t i = y * std::size_t(reference.width) + std::size_t(x);
            out.run_m.data[i] = found.run_m;
            out.edge_m.data[i] = found.edge_m;
        }
    });
    return out;
}

}  // namespace si
