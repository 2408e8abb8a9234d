// Offscreen colour target for Dear ImGui.
#pragma once

#include <epoxy/gl.h>

#include "renderer/frame/frame.h"

namespace si {

/// Offscreen RGBA8 framebuffer that Dear ImGui draws into. Needs a current OpenGL context from construction to
/// destruction.
class Canvas {
public:
    Canvas(int width, int height);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    /// Binds the canvas's framebuffer as the one to draw into.
    void bind() const;
    /// Reads back the canvas as an opaque image, top row first.
    ByteImage read_picture() const;

private:
    int width_, height_;
    GLuint texture_ = 0, framebuffer_ = 0;
};

}  // namespace si
