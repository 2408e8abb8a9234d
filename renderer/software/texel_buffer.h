// Uniform blocks as images, for drivers that draw on the CPU.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "renderer/gl/handle.h"

namespace si {

/// A buffer that shaders can read texel by texel, as an image. Drivers that draw on the CPU fetch each number of a
/// uniform block anew for every few pixels: Mesa 22.3's llvmpipe takes 0.94 ns for one and eight pixels, and 1.0 ns for
/// a texel of four from an image.
class TexelBuffer {
public:
    explicit TexelBuffer(std::string_view label);
    /// Replaces what it holds.
    void put(std::span<const std::byte> bytes);
    void bind_block(GLuint block) const;
    /// @param format of a texel, GL_RGBA32UI or GL_RG32UI
    void bind_image(GLuint image, GLenum format) const;

private:
    gl::Buffer buffer_;
    gl::Texture texels_;
    std::string label_;
    std::size_t size_ = 0;
};

}  // namespace si
