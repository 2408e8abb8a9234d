// Passes that draw one image of the visible surfaces: depth, triangle numbers, positions, map coordinates.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "renderer/frame/frame_pass.h"
#include "renderer/frame/state.h"

namespace si {

/// Draws the camera's depth and reads back the nearest and farthest visible depth, metres. Returns nullopt when no
/// surface is visible. Used by light.depth_bounds sdsm, before a frame is planned.
/// @param[out] info report on the drawing
std::optional<DepthSpan> measure_visible_depths(FrameState& f, PassInfo& info);

/// Draws the depth of visible surfaces (Resources::camera_depth) for passes that read it. Does nothing where another
/// pass from the camera (CameraDrawing) has already drawn the depth.
class CameraDepthPass : public FramePass {
public:
    void declare(FrameState& f) override;
};

/// Draws the object and triangle number that each pixel shows, see SurfaceIds.
class SurfaceIdsPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    gl::Target ids_;  ///< RG32UI
};

/// Draws position and normals of every pixel's surface. The images are kept while camera and scene stay, for passes
/// that evaluate pixels again.
class VisibleSurfacesPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    std::array<gl::Target, kVisibleSurfaceImages> images_;  ///< RGBA32F; the key of all is the first one's
    std::size_t drawn_ = 0;                                 ///< number of images that were drawn last
};

/// Draws for each pixel the map coordinates of the kernel's centre, in the map of view.light.
class MapCoordinatesPass : public FramePass {
public:
    void declare(FrameState& f) override;

private:
    gl::Target coordinates_;  ///< RGBA32F
};

/// Binds another set of surface images in place of the frame's, for evaluating other pixels with the same shaders.
void bind_visible_surfaces(std::span<const gl::Target, kVisibleSurfaceImages> seen);

}  // namespace si
