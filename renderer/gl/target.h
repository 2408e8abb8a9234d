// Textures as render targets, and framebuffers over them.
#pragma once

#include <bit>
#include <span>
#include <string>
#include <vector>

#include "renderer/gl/handle.h"

namespace si::gl {

/// Returns the number of mip levels of a texture `texels` wide, down to one texel.
constexpr int mip_levels(int texels) {
    return std::bit_width(unsigned(texels));
}

/// Number of mip levels, and of samples per texel, of a texture to draw into.
struct TargetExtent {
    int levels = 1;   ///< mip levels
    int samples = 0;  ///< samples of a multisampled texture (one layer and level); 0: not multisampled
    bool operator==(const TargetExtent&) const = default;
};

/// Texture or texture array (2-D) to draw into, with its size and the cache key of its contents.
struct Target {
    Texture texture;
    int width = 0, height = 0, layers = 0;
    TargetExtent extent;
    GLenum format = 0;
    std::uint64_t key = 0;  ///< cache key of the contents; 0: undefined

    /// Allocates the render target's texture unless it has this format and size already. Returns true when it was
    /// allocated again: its contents are then undefined.
    /// @param w,h texels @param layer_count the number of layers; 0: a plain 2-D texture
    /// @throws OutOfMemory naming the size
    bool ensure(std::string_view label, GLenum internal_format, int w, int h, int layer_count = 0,
                const TargetExtent& more = {});
};

/// Counts the bytes of a texture's images in the memory report, by its format and size. @param holder name in the
/// report, see TrackedMemory
void track_image_memory(Texture& texture, std::string_view holder, const TargetExtent& extent = {});

/// Creates a framebuffer with at most one colour and one depth attachment.
/// @param label name in frame debuggers and error messages
/// @param colour,depth textures to attach; null: none
/// @param colour_layer,depth_layer layer of an array texture; -1: all layers
/// @throws Error when the driver cannot draw into them
Framebuffer make_framebuffer(std::string_view label, const Target* colour, const Target* depth, int colour_layer = -1,
                             int depth_layer = -1);

/// Creates a framebuffer with several colour attachments, in the order of `colours`, and a depth attachment.
/// @param label name in frame debuggers and error messages
/// @throws Error when the driver cannot draw into them
Framebuffer make_framebuffer(std::string_view label, std::span<const Target> colours, const Target& depth);

/// Creates a framebuffer in which each layer of an array texture is a colour attachment, so that one draw writes all
/// layers.
/// @param label name in frame debuggers and error messages
/// @throws Error when the driver cannot draw into them
Framebuffer make_layers_framebuffer(std::string_view label, const Target& colours);

/// Returns the pixel format for reading back an image with one channel: GL_RED for R32F and R16, GL_DEPTH_COMPONENT for
/// depth formats.
GLenum single_channel_format(GLenum internal_format);

/// Prepares OpenGL for reading pixels into memory: packs rows without gaps and waits for pending draws. OpenGL itself
/// promises this wait. However, llvmpipe (Mesa 22.3) sometimes returns the old contents of a texture for which only a
/// clear is pending.
void prepare_read_back();

/// Returns the size of a read-back as OpenGL takes it, which is a signed number of 32 bits.
/// @throws Error for a larger size
GLsizei read_back_size(std::size_t bytes);

/// Reads back the finest level of a texture, bottom row first.
/// @param count numbers of type T in the texture @param format,type as for glGetTextureImage()
/// @throws Error for more bytes than read_back_size() allows
template <typename T>
std::vector<T> read_texture(GLuint texture, std::size_t count, GLenum format, GLenum type) {
    const GLsizei bytes = read_back_size(count * sizeof(T));
    std::vector<T> out(count);
    prepare_read_back();
    glGetTextureImage(texture, 0, format, type, bytes, out.data());
    return out;
}

}  // namespace si::gl
