// What all shaders of a frame read: the frame's block and the settings'.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

#include "renderer/gl/handle.h"
#include "shaders/shared/units.h"

namespace si {

/// A buffer that shaders see as a uniform block and as an image of RGBA32UI texels, four numbers each. Drivers that
/// draw on the CPU fetch each number of a uniform block anew for every few pixels: Mesa 22.3's llvmpipe takes 0.94 ns
/// for one and eight pixels, and 1.0 ns for a texel of four from an image.
class BlockBuffer {
public:
    BlockBuffer() = default;
    /// @param block,image where shaders find it (shared/units.h)
    BlockBuffer(std::string_view label, GLuint block, GLuint image);
    /// Replaces what it holds, and binds it as both. @param bytes a multiple of 16
    void put(std::span<const std::byte> bytes);

private:
    gl::Buffer buffer_;
    gl::Texture texels_;
    GLuint block_ = 0, image_ = 0;
};

/// Places of disks, which shaders read as an image of RG32UI texels.
class DiskBuffer {
public:
    DiskBuffer();
    /// Replaces what it holds, and binds it to shared::IMAGE_DISK_PLACES.
    void put(std::span<const glm::vec2> places);

private:
    gl::Buffer buffer_;
    gl::Texture texels_;
};

struct Blocks {
    DiskBuffer disk;
    BlockBuffer frame{"frame uniforms", shared::BLOCK_FRAME, shared::IMAGE_FRAME_BLOCK};
    BlockBuffer settings{"settings uniforms", shared::BLOCK_SETTINGS, shared::IMAGE_SETTINGS_BLOCK};
};

/// How shaders read them, as GLSL text that stands before every shader.
/// @param as_images by images where single numbers are read, else by uniform blocks; the bits are the same
std::string blocks_text(bool as_images);

}  // namespace si
