// Offscreen colour target for Dear ImGui.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/handle.h"

namespace si {

/// Offscreen RGBA8 framebuffer into which Dear ImGui draws the editor. It needs a current OpenGL context from
/// construction to destruction.
class Canvas {
public:
    Canvas(int width, int height);

    /// Binds the canvas's framebuffer as the one to draw into.
    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id()); }
    /// Reads the pixels of this offscreen framebuffer back from the GPU. Returns an opaque image, top row first.
    ByteImage read_picture() const;

private:
    int width_, height_;
    gl::Texture texture_ = gl::Texture::create("editor", GL_TEXTURE_2D);
    gl::Framebuffer framebuffer_ = gl::Framebuffer::create("editor");
};

}  // namespace si
