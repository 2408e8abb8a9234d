// The surface point behind each pixel, in double.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/base/big_array.h"
#include "renderer/frame/frame.h"
#include "renderer/reference/truth_geometry.h"
#include "renderer/reference/workers.h"
#include "renderer/view/camera.h"

namespace si {

struct Receiver {
    static constexpr std::uint32_t kNothing = 0xffffffff;
    glm::dvec3 position_ws{0};
    glm::dvec3 normal_ws{0};  ///< of the triangle, unit, on the side that the camera sees
    float edge_m = 0;         ///< the triangle's longest edge
    std::uint32_t object = kNothing, primitive = 0;
    /// Whether the right and the lower neighbour show the same surface: neither lies off the other's plane.
    bool joins_right = false, joins_below = false;
    bool hit() const { return object != kNothing; }
};

/// The receiver's point in the unit frame, lifted off its surface by what single precision may err.
glm::vec3 ray_origin(const UnitFrame& frame, const Receiver& receiver);

/// What most rays need of a receiver, half as large as it.
struct RayStart {
    glm::vec3 origin{0};  ///< ray_origin()
    glm::vec3 normal{0};
    std::uint32_t object = Receiver::kNothing;
};

/// One per pixel, top row first.
struct Receivers {
    int width = 0, height = 0;
    BigArray<Receiver> pixels;
    BigArray<RayStart> starts = {};  ///< of the pixels, or empty: traces then take longer
    HeldMemory held = {};            ///< what they take
    const Receiver& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// Which pixels of the camera's picture are placed: every `step`-th across and down, from `first` on.
struct PixelRaster {
    int width = 0, height = 0;  ///< of the camera's picture
    int step = 1;
    glm::ivec2 first{0};  ///< pixel of the picture that is placed first
    int columns() const { return (width + step - 1) / step; }
    int rows() const { return (height + step - 1) / step; }
};

/// Meets each pixel's ray with the plane of the triangle that the GPU drew there, in double, and keeps the point inside
/// the triangle (rasterisers snap corners, so the ray may pass by a hair).
/// @param ids Outputs::surface_ids of a frame of the same scene and camera, those of the raster
/// @throws Cancelled; Error when an id names no triangle of the geometry
Receivers place_receivers(const ReferenceGeometry& geometry, const Camera& camera, const SurfaceIds& ids,
                          const PixelRaster& raster, const Workers& workers);
/// Every pixel.
inline Receivers place_receivers(const ReferenceGeometry& geometry, const Camera& camera, const SurfaceIds& ids,
                                 const Workers& workers) {
    return place_receivers(geometry, camera, ids, {ids.width, ids.height}, workers);
}

}  // namespace si
