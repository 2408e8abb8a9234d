// Clipping of segments to a rectangle.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <optional>
#include <utility>

namespace si {

/// Returns the part of a segment inside the rectangle lo..hi; none if the segment lies outside. Liang and Barsky, A New
/// Concept and Method for Line Clipping, ACM TOG 3(1), 1984.
inline std::optional<std::pair<glm::dvec2, glm::dvec2>> clip_to_box(const glm::dvec2& from, const glm::dvec2& to,
                                                                    const glm::dvec2& lo, const glm::dvec2& hi) {
    const glm::dvec2 way = to - from;
    double begin = 0, end = 1;
    for (int axis = 0; axis < 2; ++axis) {
        if (way[axis] == 0) {
            if (from[axis] < lo[axis] || from[axis] > hi[axis]) return {};
            continue;
        }
        const double a = (lo[axis] - from[axis]) / way[axis], b = (hi[axis] - from[axis]) / way[axis];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    if (!(begin <= end)) return {};
    return std::pair{from + begin * way, from + end * way};
}

}  // namespace si
