// Uniform blocks read as images, for drivers that draw on the CPU.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "renderer/gl/handle.h"

namespace si {

/// GPU buffer that shaders read as a uniform block, or texel by texel as an image. The image is faster on drivers that
/// draw on the CPU, which fetch each number of a uniform block again for every few pixels. Mesa 22.3's llvmpipe takes
/// 0.94 ns for one number and eight pixels, and 1.0 ns for an image texel of four numbers.
class TexelBuffer {
public:
    /// Makes an empty buffer that shaders read as uniform block or image.
    /// @param label name of the OpenGL object in frame debuggers
    explicit TexelBuffer(std::string_view label);
    /// Replaces the contents of this GPU buffer (a uniform block or image) by bytes from the CPU.
    void upload(std::span<const std::byte> bytes);
    /// Binds this GPU buffer as a uniform block.
    /// @param block uniform block binding point
    void bind_block(GLuint block) const;
    /// Binds this GPU buffer as a buffer image, from which shaders read texels.
    /// @param image image unit
    /// @param format texel format, GL_RGBA32UI or GL_RG32UI
    void bind_image(GLuint image, GLenum format) const;

private:
    gl::Buffer buffer_;
    gl::Texture texels_;
    std::string label_;
    std::size_t size_ = 0;
};

}  // namespace si
