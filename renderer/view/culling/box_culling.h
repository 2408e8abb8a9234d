// Culling of boxes against the frustum of a view, conservative for float rounding in the driver.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/projection/light_view.h"
#include "renderer/scene/scene.h"

namespace si {

/// World-space parallelepiped: the bounding box of a mesh after an affine transform.
struct SkewBox {
    glm::dvec3 centre{0};  ///< world
    glm::dmat3 half{0.0};  ///< columns: vectors from the centre to the centres of three faces
    /// Makes an empty box at the origin.
    SkewBox() = default;
    /// Transforms the bounds of a mesh to world space.
    /// @param local bounds in the space of the mesh
    /// @param world world_from_mesh
    SkewBox(const Bounds& local, const glm::dmat4& world)
        : centre(world * glm::dvec4(local.centre(), 1)), half(glm::dmat3(world)) {
        for (int i = 0; i < 3; ++i) half[i] *= 0.5 * (local.hi[i] - local.lo[i]);
    }
};

/// Frustum test that finds the boxes that a view (of the camera or a light) need not draw. Errs on the safe side: a box
/// that might cover a texel is never reported as outside.
class BoxCuller {
public:
    /// Makes the frustum test of boxes from the matrix of a view (of the camera or a light).
    /// @param clip_from_relative clip space from positions relative to `origin` (world)
    /// @param clamps_near true: casters before the near plane are drawn on it (pancaking), so near and far planes do
    /// not cull
    /// @param resolution texels along a side of the map
    BoxCuller(const glm::dmat4& clip_from_relative, const glm::dvec3& origin, const DepthConvention& convention,
              bool clamps_near, int resolution);
    /// Returns true when no part of a world-space box can cover a texel of the view, so that the object need not be
    /// drawn.
    bool is_outside(const SkewBox& box) const;
    /// Returns true when a world-space box lies wholly in front of the viewer and the near plane does not cut it. The
    /// viewer is then outside the box.
    bool is_in_front(const SkewBox& box) const;

private:
    glm::dvec3 origin_;
    bool clamps_near_;
    double texel_;  ///< width of a texel in normalised device coordinates
    /// Planes with values of 0 or more on their inner side: left, right, bottom, top, near, far, and w.
    std::array<glm::dvec4, 7> planes_;
    /// Smallest and largest value of the equation of a frustum plane over a box, with a bound of their float rounding.
    struct Span {
        double min, max;
        double slack;  ///< float rounding of the value
    };
    /// Returns the smallest and largest signed distance of a box from a frustum plane (values of the plane's equation),
    /// and a bound of their float rounding (Span::slack).
    /// @param plane index into `planes_`
    Span span_of(std::size_t plane, const SkewBox& box) const;
};

}  // namespace si
