#include "renderer/frame/driver.h"

#include <fmt/format.h>

#include <iterator>

#include "renderer/base/error.h"
#include "renderer/software/rasteriser.h"

namespace si {
namespace {

std::string text(GLenum name) {
    const auto* s = reinterpret_cast<const char*>(glGetString(name));
    return s ? s : "";
}

int integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

}  // namespace

DriverInfo query_driver() {
    if (epoxy_gl_version() < 45)
        throw Error(
            fmt::format("OpenGL 4.5 is needed, the driver offers {}; update it, or use Mesa's software driver "
                        "with LIBGL_ALWAYS_SOFTWARE=1",
                        text(GL_VERSION)));
    DriverInfo d;
    d.vendor = text(GL_VENDOR);
    d.renderer = text(GL_RENDERER);
    d.version = text(GL_VERSION);
    d.glsl = text(GL_SHADING_LANGUAGE_VERSION);
    d.max_texture_size = integer(GL_MAX_TEXTURE_SIZE);
    d.subpixel_bits = integer(GL_SUBPIXEL_BITS);
    d.max_samples = integer(GL_MAX_SAMPLES);
    d.polygon_offset_clamp = epoxy_has_gl_extension("GL_EXT_polygon_offset_clamp");
    d.anisotropy = epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic");
    if (d.anisotropy) {
        float most = 1;
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &most);
        d.max_anisotropy = most;
    }
    GLint counts = 0;
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, GL_DEPTH_COMPONENT32F, GL_NUM_SAMPLE_COUNTS, 1, &counts);
    d.map_samples.resize(std::size_t(counts));
    if (counts > 0)
        glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, GL_DEPTH_COMPONENT32F, GL_SAMPLES, counts,
                              d.map_samples.data());
    d.software = draws_on_cpu(d.renderer);
    d.blocks_as_images = reads_blocks_as_images(d.renderer);
    return d;
}

GLenum map_internal_format(MapFormat format) {
    // In the order of MapFormat.
    static constexpr GLenum kFormats[] = {
        GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F, GL_R32F, GL_R32F, GL_R16};
    static_assert(std::size(kFormats) == kMapFormats);
    return kFormats[std::size_t(format)];
}

}  // namespace si
