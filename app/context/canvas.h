// A colour target of its own that Dear ImGui draws into.
#pragma once

#include <epoxy/gl.h>

#include "renderer/frame/frame.h"

namespace si {

/// Needs a current OpenGL context from construction to destruction.
class Canvas {
public:
    Canvas(int width, int height);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    void bind() const;
    /// What was drawn, opaque, top row first.
    ByteImage picture() const;

private:
    int width_, height_;
    GLuint texture_ = 0, framebuffer_ = 0;
};

}  // namespace si
