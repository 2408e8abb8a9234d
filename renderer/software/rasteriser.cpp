#include "renderer/software/rasteriser.h"

#include <epoxy/gl.h>

namespace si {

bool draws_on_cpu(std::string_view renderer) {
    for (const std::string_view name : {"llvmpipe", "softpipe", "SwiftShader", "swr"})
        if (renderer.find(name) != std::string_view::npos) return true;
    return false;
}

bool reads_blocks_as_images(std::string_view renderer) {
    // Mesa 22.3's zink lets a draw read image-buffer content that the next draw writes.
    if (!draws_on_cpu(renderer) || renderer.find("zink") != std::string_view::npos) return false;
    // Passes that record the texels they read use one image more.
    GLint vertex_images = 0;
    GLint fragment_images = 0;
    glGetIntegerv(GL_MAX_VERTEX_IMAGE_UNIFORMS, &vertex_images);
    glGetIntegerv(GL_MAX_FRAGMENT_IMAGE_UNIFORMS, &fragment_images);
    return vertex_images >= 2 && fragment_images >= 4;
}

}  // namespace si
