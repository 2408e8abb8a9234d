// Offscreen colour target for Dear ImGui.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/handle.h"

namespace si {

/// Offscreen RGBA8 framebuffer that Dear ImGui draws into. Needs a current OpenGL context from construction to
/// destruction.
class Canvas {
public:
    Canvas(int width, int height);

    /// Binds the canvas's framebuffer as the one to draw into.
    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id()); }
    /// Reads back the canvas as an opaque image, top row first.
    ByteImage read_picture() const;

private:
    int width_, height_;
    gl::Texture texture_ = gl::Texture::create("editor", GL_TEXTURE_2D);
    gl::Framebuffer framebuffer_ = gl::Framebuffer::create("editor");
};

}  // namespace si
