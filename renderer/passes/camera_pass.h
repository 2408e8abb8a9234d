// Helper for passes that draw the scene's visible surfaces.
#pragma once

#include "renderer/frame/state.h"

namespace si {

/// Draws the scene from the camera into images of the picture's size, with a depth test against the shared camera
/// depth. The first CameraPass of a frame draws the camera depth too.
class CameraPass {
public:
    /// Resizes the images where needed, without keeping their contents, and binds them for drawing.
    /// @param label name in error messages and frame debuggers
    CameraPass(FrameState& f, std::string_view label, GLenum format, std::span<gl::Target> images);
    /// Resizes one image where needed and binds it for drawing.
    CameraPass(FrameState& f, std::string_view label, GLenum format, gl::Target& image)
        : CameraPass(f, label, format, std::span(&image, 1)) {}
    /// Binds one layer of an image that already has the picture's size.
    CameraPass(FrameState& f, std::string_view label, const gl::Target& image, int layer);
    /// Binds no image, for drawing the camera's depth alone.
    explicit CameraPass(FrameState& f) : CameraPass(f, "camera depth", GL_NONE, {}) {}
    /// Clears all bound images to a value.
    CameraPass& clear(const glm::vec4& value);
    /// Clears all bound integer images to a value.
    CameraPass& clear(const glm::uvec4& value);
    /// Draws all opaque and masked objects with a fragment shader.
    /// @param[out] info draw counts
    void draw(std::string_view fragment, const std::vector<gl::Define>& extra, PassInfo& info) const {
        f_.draw_from_camera(fragment, extra, info);
    }

private:
    /// Binds the framebuffer, and clears the camera depth if no pass of the frame has drawn it yet.
    void begin();

    FrameState& f_;
    GLint images_ = 1;
    gl::Framebuffer framebuffer_;
};

}  // namespace si
