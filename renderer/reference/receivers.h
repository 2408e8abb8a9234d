// Surface point of each pixel (the shadow receiver), in double precision.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/base/workers.h"
#include "renderer/frame/frame.h"
#include "renderer/projection/camera.h"
#include "renderer/reference/reference_geometry.h"
#include "renderer/software/big_array.h"

namespace si {

/// Surface point that a pixel shows (the receiver of shadows), with its triangle.
struct Receiver {
    static constexpr std::uint32_t kNothing = 0xffffffff;
    glm::dvec3 position_ws{0};
    glm::dvec3 normal_ws{0};  ///< unit normal of the triangle, on the camera's side
    float edge_m = 0;         ///< length of the triangle's longest edge, metres
    std::uint32_t object = kNothing, primitive = 0;
    bool front = true;  ///< the camera sees the triangle's front face
    /// True when the right, or the lower, neighbour pixel shows the same surface: each of the two points lies near the
    /// plane of the other.
    bool same_surface_right = false, same_surface_below = false;
    /// Returns true when the receiver's pixel shows a surface.
    bool hit() const { return object != kNothing; }
};

/// Returns the start of shadow rays from a receiver, in the unit frame (UnitFrame: the scene centred and scaled to
/// about one unit). The start is shifted off the surface by a bound of the single-precision rounding error, so that
/// rays do not hit the receiver's own surface.
glm::vec3 ray_origin(const UnitFrame& frame, const Receiver& receiver);

/// Compact copy of a receiver (surface point of a pixel) for ray tracing. It is half as large, and has all that most
/// shadow rays need.
struct RayStart {
    glm::vec3 origin{0};  ///< start of shadow rays: ray_origin()
    glm::vec3 normal{0};
    std::uint32_t object = Receiver::kNothing;
};

/// Surface points (receivers of shadows) of all pixels of a picture, top row first.
struct Receivers {
    int width = 0, height = 0;
    BigArray<Receiver> pixels;
    BigArray<RayStart> starts = {};  ///< one per pixel; may be empty, but traces then take longer
    TrackedMemory held = {};         ///< bytes of both arrays
    /// Returns the surface point of pixel (x, y), counted from the top left.
    const Receiver& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// Pixels of the camera's picture that the ray-traced reference samples: every `step`-th across and down, starting at
/// `first`.
struct PixelRaster {
    int width = 0, height = 0;  ///< size of the camera's picture, pixels
    int step = 1;
    glm::ivec2 first{0};  ///< top left sampled pixel
    /// Returns the number of sampled pixels across the picture.
    int columns() const { return (width + step - 1) / step; }
    /// Returns the number of sampled pixels down the picture.
    int rows() const { return (height + step - 1) / step; }
};

/// Reconstructs the surface point of each sampled pixel in double precision: intersects the pixel's ray with the plane
/// of the triangle that the GPU drew there, and clamps the point to the triangle. The ray may miss the triangle
/// slightly, as rasterisers snap corners.
/// @param ids Outputs::surface_ids of a frame of the same scene and camera, at the sampled pixels
/// @param raster sampled pixels of the picture
/// @throws Cancelled; Error when an id names no triangle of the geometry
Receivers reconstruct_receivers(const ReferenceGeometry& geometry, const Camera& camera, const SurfaceIds& ids,
                                const PixelRaster& raster, const Workers& workers);
/// Reconstructs the surface point of every pixel of the picture.
inline Receivers reconstruct_receivers(const ReferenceGeometry& geometry, const Camera& camera, const SurfaceIds& ids,
                                       const Workers& workers) {
    return reconstruct_receivers(geometry, camera, ids, {ids.width, ids.height}, workers);
}

}  // namespace si
