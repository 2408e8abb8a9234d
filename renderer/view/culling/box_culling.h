// Which boxes a map's view can draw something of, in double and on the safe side of a driver's floats.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/projection/light_view.h"
#include "renderer/scene/scene.h"

namespace si {

/// A box that need not stand upright, nor have right angles.
struct SkewBox {
    glm::dvec3 centre{0};  ///< world
    glm::dmat3 half{0.0};  ///< columns: from the centre to three faces' centres
    SkewBox() = default;
    SkewBox(const Bounds& local, const glm::dmat4& world)
        : centre(world * glm::dvec4(local.centre(), 1)), half(glm::dmat3(world)) {
        for (int i = 0; i < 3; ++i) half[i] *= 0.5 * (local.hi[i] - local.lo[i]);
    }
};

class BoxCuller {
public:
    /// @param clip_from_relative of positions relative to `origin`
    BoxCuller(const glm::dmat4& clip_from_relative, const glm::dvec3& origin, const DepthConvention& convention,
              bool clamps_near, int resolution);
    /// Nothing in the box covers a texel.
    bool misses(const SkewBox& box) const;
    /// All of the box lies before the viewer, and the near plane cuts nothing of it: the viewer is outside of it.
    bool is_in_front(const SkewBox& box) const;

private:
    glm::dvec3 origin_;
    bool clamps_near_;
    double texel_;
    /// A plane's value is 0 or more on its inner side; left, right, bottom, top, near, far, and w.
    std::array<glm::dvec4, 7> planes_;
    struct Span {
        double least, most;
        double slack;  ///< by how much floats may be off
    };
    Span span_of(std::size_t plane, const SkewBox& box) const;
};

}  // namespace si
