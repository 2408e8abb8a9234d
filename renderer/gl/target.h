// Textures one can draw into.
#pragma once

#include <bit>
#include <span>
#include <string>

#include "renderer/gl/handle.h"

namespace si::gl {

/// How many mip levels a texture of so many texels across has, down to a single texel.
constexpr int mip_levels(int texels) {
    return std::bit_width(unsigned(texels));
}

/// What else a target's texture may have.
struct TargetExtent {
    int levels = 1;   ///< mip levels
    int samples = 0;  ///< of a multisampled texture, which has one layer and level; 0: it is none
    bool operator==(const TargetExtent&) const = default;
};

/// A 2-D (array) texture with immutable storage; allocated anew only when its shape changes.
struct Target {
    Texture texture;
    int width = 0, height = 0, layers = 0;
    TargetExtent extent;
    GLenum format = 0;
    std::uint64_t key = 0;  ///< of the contents; 0: undefined

    /// layers == 0 makes a plain 2-D texture. Returns true when it was allocated anew (contents undefined).
    /// @throws Error when the driver is out of memory, naming the size.
    bool ensure(std::string_view label, GLenum internal_format, int w, int h, int layer_count = 0,
                const TargetExtent& more = {});
};

/// Has a texture tell how many bytes its images take, as its format says. @param holder see TrackedMemory
void track_image_memory(Texture& texture, std::string_view holder, const TargetExtent& extent = {});

/// A framebuffer of up to one colour and one depth attachment; layer -1 attaches whole textures.
Framebuffer make_framebuffer(std::string_view label, const Target* colour, const Target* depth, int colour_layer = -1,
                             int depth_layer = -1);

/// One of several colour attachments, in their order, and a depth.
Framebuffer make_framebuffer(std::string_view label, std::span<const Target> colours, const Target& depth);

/// Each layer of an array texture as a colour attachment of its own.
Framebuffer make_layers_framebuffer(std::string_view label, const Target& colours);

/// What images of one number a pixel are read back as: GL_RED, or GL_DEPTH_COMPONENT.
GLenum single_channel_format(GLenum internal_format);

/// Before pixels are read back into memory: rows without gaps, and what is drawn is there. OpenGL promises the latter,
/// but llvmpipe of Mesa 22.3 now and then hands out what a target held before, where all that is under way is a clear.
void prepare_read_back();

}  // namespace si::gl
