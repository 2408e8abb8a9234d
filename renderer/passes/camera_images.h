// Passes that draw one image of the visible surfaces: depth, triangle numbers, positions, map coordinates.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws the camera's depth and reads back the nearest and farthest visible depth, metres. Returns nullopt when no
/// surface is visible. Used before a frame is planned, where maps are narrowed to visible depths (light.depth_bounds
/// sdsm).
/// @param[out] info report on the drawing
std::optional<DepthSpan> measure_visible_depths(FrameState& f, PassInfo& info);

/// Pass that draws the depth of visible surfaces (Resources::camera_depth) for passes that read it. Does nothing where
/// another pass from the camera (CameraDrawing) has already drawn the depth.
class CameraDepthPass : public FramePass {
public:
    void declare(FrameState& f) override;
};

/// Pass that draws the object and triangle number that each pixel shows, see SurfaceIds.
class SurfaceIdsPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    gl::Target ids_;  ///< RG32UI
};

/// Pass that draws position and normals of every pixel's surface. The images are kept while camera and scene stay
/// unchanged, so that passes can evaluate shadows of the pixels again without drawing the scene.
class VisibleSurfacesPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    std::array<gl::Target, kVisibleSurfaceImages> images_;  ///< RGBA32F; the first one has the cache key of all
    std::size_t drawn_ = 0;                                 ///< number of images that were drawn last
};

/// Pass that draws for each pixel the map coordinates at which its shadow look-up is centred, in the map of view.light.
class MapCoordinatesPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    gl::Target coordinates_;  ///< RGBA32F
};

/// Binds other images of surfaces (positions and normals) in place of the frame's visible surfaces. Shaders that read
/// visible surfaces then evaluate other points.
/// @param seen images as VisibleSurfacesPass draws them
void bind_visible_surfaces(std::span<const gl::Target, kVisibleSurfaceImages> seen);

}  // namespace si
