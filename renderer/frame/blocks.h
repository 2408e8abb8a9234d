// What all shaders of a frame read: the frame's block and the settings'.
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

struct FrameState;
namespace shared {
struct FrameBlock;
}
/// What stands in the frame's block.
shared::FrameBlock frame_block(const FrameState& f);
/// Has shaders read another.
void put_frame_block(const FrameState& f, const shared::FrameBlock& block);

struct Blocks {
    TexelBuffer frame{"frame uniforms"}, settings{"settings uniforms"};
    TexelBuffer disk{"places of disks"};  ///< of kernels that sample a circle
};

/// How shaders read them, as GLSL text that stands before every shader.
/// @param as_images by images where single numbers are read, else by uniform blocks; the bits are the same
std::string blocks_text(bool as_images);

}  // namespace si
