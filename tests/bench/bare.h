// The measuring stick: the least OpenGL that draws the same scene with the same kernel, all vertices in world space in
// one buffer, two draws a frame, no settings, no overlays.
#pragma once

#include "renderer/frame.h"
#include "renderer/gl/handle.h"
#include "renderer/gl/target.h"

namespace si {

class BareForward {
public:
    /// kernel_size 0: no shadows at all (one pass); 1: 2x2 bilinear by one gather; 3, 5, 7: N x N bilinear by gathers;
    /// -1: one nearest tap.
    BareForward(const Scene& scene, int kernel_size, int map_resolution, int width, int height);
    /// Draws a frame with the camera and light that the renderer found; `depth_pass` off leaves the map as it is.
    void draw(const Camera& camera, const FittedLight& light, bool depth_pass = true, bool shade_pass = true);

private:
    int kernel_, resolution_, width_, height_;
    GLsizei count_ = 0;
    gl::VertexArray vao_;
    gl::Buffer vertices_, indices_;
    gl::Program depth_program_, shade_program_;
    gl::Target map_, colour_, depth_;
    gl::Framebuffer map_framebuffer_, framebuffer_;
    glm::dvec3 origin_;
};

}  // namespace si
