// Helper of passes that draw the scene's visible surfaces.
#pragma once

#include "renderer/frame/state.h"

namespace si {

/// Helper of passes that draw visible surfaces into images: binds the images with the shared camera depth, clears them,
/// and draws the scene. A pass constructs a CameraDrawing while it runs. The first CameraDrawing of a frame also draws
/// the camera depth where needed.
class CameraDrawing {
public:
    /// Resizes the images to the picture's size where needed, without keeping their contents, and binds them for
    /// drawing visible surfaces.
    /// @param label name in error messages and frame debuggers
    CameraDrawing(FrameState& f, std::string_view label, GLenum format, std::span<gl::Target> images);
    /// Resizes one image to the picture's size where needed, and binds it for drawing visible surfaces.
    CameraDrawing(FrameState& f, std::string_view label, GLenum format, gl::Target& image)
        : CameraDrawing(f, label, format, std::span(&image, 1)) {}
    /// Binds one layer of an image that already has the picture's size, for drawing visible surfaces.
    CameraDrawing(FrameState& f, std::string_view label, const gl::Target& image, int layer);
    /// Binds no image, for drawing the camera's depth alone.
    explicit CameraDrawing(FrameState& f) : CameraDrawing(f, "camera depth", GL_NONE, {}) {}
    /// Clears all bound images to a value, and returns this object for chaining.
    CameraDrawing& clear(const glm::vec4& value);
    /// Clears all bound integer images to a value, and returns this object for chaining.
    CameraDrawing& clear(const glm::uvec4& value);
    /// Draws the opaque and masked objects that the camera sees.
    /// @param fragment fragment shader file
    /// @param extra more defines of the shader
    /// @param[out] info draw and triangle counts
    void draw(std::string_view fragment, const std::vector<gl::Define>& extra, PassInfo& info) const {
        f_.draw_from_camera(fragment, extra, info);
    }

private:
    /// Begins drawing visible surfaces: binds the framebuffer, and clears the camera depth if no pass of the frame has
    /// drawn it yet.
    void begin();

    FrameState& f_;
    GLint images_ = 1;
    gl::Framebuffer framebuffer_;
};

}  // namespace si
