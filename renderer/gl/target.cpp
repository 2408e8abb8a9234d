#include "renderer/gl/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "renderer/base/error.h"
#include "renderer/gl/driver_failure.h"

namespace si::gl {

bool Target::ensure(std::string_view label, GLenum internal_format, int w, int h, int layer_count,
                    const TargetExtent& more) {
    if (texture && format == internal_format && width == w && height == h && layers == layer_count && extent == more)
        return false;
    texture.reset();
    key = 0;
    clear_gl_errors();
    texture = Texture::create(label, GLenum(more.samples  ? GL_TEXTURE_2D_MULTISAMPLE
                                            : layer_count ? GL_TEXTURE_2D_ARRAY
                                                          : GL_TEXTURE_2D));
    if (more.samples)
        glTextureStorage2DMultisample(texture.id(), more.samples, internal_format, w, h, GL_TRUE);
    else if (layer_count)
        glTextureStorage3D(texture.id(), more.levels, internal_format, w, h, layer_count);
    else
        glTextureStorage2D(texture.id(), more.levels, internal_format, w, h);
    try {
        check_memory_errors(fmt::format("{} ({} x {} x {})", label, w, h, layer_count ? layer_count : 1),
                            "use a smaller size, map.resolution or fewer lights");
    } catch (...) {
        texture.reset();
        width = height = layers = 0;
        throw;
    }
    width = w;
    height = h;
    layers = layer_count;
    format = internal_format;
    extent = more;
    track_image_memory(texture, label, more);
    if (more.samples) return true;  // multisampled textures have no sampler state
    glTextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return true;
}

void track_image_memory(Texture& texture, std::string_view holder, const TargetExtent& extent) {
    const auto of_level = [&](int level, GLenum what) {
        GLint value = 0;
        glGetTextureLevelParameteriv(texture.id(), level, what, &value);
        return std::uint64_t(std::max(value, 0));
    };
    std::uint64_t bits = 0, texels = 0;
    for (const GLenum channel : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE,
                                 GL_TEXTURE_ALPHA_SIZE, GL_TEXTURE_DEPTH_SIZE, GL_TEXTURE_STENCIL_SIZE})
        bits += of_level(0, channel);
    for (int level = 0; level < extent.levels; ++level)
        texels +=
            of_level(level, GL_TEXTURE_WIDTH) * of_level(level, GL_TEXTURE_HEIGHT) * of_level(level, GL_TEXTURE_DEPTH);
    texture.track_memory(holder, texels * std::uint64_t(std::max(extent.samples, 1)) * bits / 8);
}

namespace {
void attach(GLuint framebuffer, GLenum point, const Target& t, int layer) {
    if (layer < 0)
        glNamedFramebufferTexture(framebuffer, point, t.texture.id(), 0);
    else
        glNamedFramebufferTextureLayer(framebuffer, point, t.texture.id(), 0, layer);
}

void require_complete(const Framebuffer& fb, std::string_view label) {
    const GLenum status = glCheckNamedFramebufferStatus(fb.id(), GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw Error(fmt::format("the driver cannot draw into {} (framebuffer status {:#x})", label, status));
}
/// Makes the first `count` colour attachments of a framebuffer its outputs, in their order.
void draw_into_colours(const Framebuffer& fb, std::string_view label, std::size_t count) {
    std::vector<GLenum> buffers(count);
    std::iota(buffers.begin(), buffers.end(), GLenum(GL_COLOR_ATTACHMENT0));
    glNamedFramebufferDrawBuffers(fb.id(), GLsizei(count), buffers.data());
    require_complete(fb, label);
}

}  // namespace

Framebuffer make_framebuffer(std::string_view label, const Target* colour, const Target* depth, int colour_layer,
                             int depth_layer) {
    auto fb = Framebuffer::create(label);
    if (colour) attach(fb.id(), GL_COLOR_ATTACHMENT0, *colour, colour_layer);
    if (depth) attach(fb.id(), GL_DEPTH_ATTACHMENT, *depth, depth_layer);
    glNamedFramebufferDrawBuffer(fb.id(), colour ? GL_COLOR_ATTACHMENT0 : GL_NONE);
    glNamedFramebufferReadBuffer(fb.id(), colour ? GL_COLOR_ATTACHMENT0 : GL_NONE);
    require_complete(fb, label);
    return fb;
}

Framebuffer make_framebuffer(std::string_view label, std::span<const Target> colours, const Target& depth) {
    auto fb = Framebuffer::create(label);
    for (std::size_t i = 0; i < colours.size(); ++i) attach(fb.id(), GL_COLOR_ATTACHMENT0 + GLenum(i), colours[i], -1);
    attach(fb.id(), GL_DEPTH_ATTACHMENT, depth, -1);
    draw_into_colours(fb, label, colours.size());
    return fb;
}

Framebuffer make_layers_framebuffer(std::string_view label, const Target& colours) {
    auto fb = Framebuffer::create(label);
    for (int i = 0; i < colours.layers; ++i) attach(fb.id(), GL_COLOR_ATTACHMENT0 + GLenum(i), colours, i);
    draw_into_colours(fb, label, std::size_t(colours.layers));
    return fb;
}

GLenum single_channel_format(GLenum internal_format) {
    return internal_format == GL_R32F || internal_format == GL_R16 ? GL_RED : GL_DEPTH_COMPONENT;
}

void prepare_read_back() {
    glFinish();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
}

GLsizei read_back_size(std::size_t bytes) {
    constexpr auto kMost = std::size_t(std::numeric_limits<GLsizei>::max());
    if (bytes > kMost)
        throw Error(
            fmt::format("an image of {} bytes cannot be read back: OpenGL returns at most {}; draw a smaller "
                        "picture (--size) or smaller maps (map.resolution)",
                        bytes, kMost));
    return GLsizei(bytes);
}

}  // namespace si::gl
