// A pass over what the camera sees.
#pragma once

#include "renderer/frame/state.h"

namespace si {

/// Draws the scene's objects into images of the picture's size over the camera's depth, which all such passes share:
/// the first brings it.
class CameraPass {
public:
    /// Makes the images fit; they need not hold anything. `label` names them in messages and frame debuggers.
    CameraPass(FrameState& f, std::string_view label, GLenum format, std::span<gl::Target> images);
    CameraPass(FrameState& f, std::string_view label, GLenum format, gl::Target& image)
        : CameraPass(f, label, format, std::span(&image, 1)) {}
    /// Into one layer of an image that fits.
    CameraPass(FrameState& f, std::string_view label, const gl::Target& image, int layer);
    /// Without an image, for the depth alone.
    explicit CameraPass(FrameState& f) : CameraPass(f, "camera depth", GL_NONE, {}) {}
    CameraPass& clear(const glm::vec4& value);
    CameraPass& clear(const glm::uvec4& value);
    void draw(std::string_view fragment, const std::vector<gl::Define>& extra, PassInfo& info) const {
        f_.draw_from_camera(fragment, extra, info);
    }

private:
    void begin();

    FrameState& f_;
    GLint images_ = 1;
    gl::Framebuffer framebuffer_;
};

}  // namespace si
