// Pictures and maps back from the GPU, top row first.
#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/frame/renderer_impl.h"

namespace si {
namespace {

template <typename T>
void flip_rows(std::vector<T>& data, int width, int height, int channels) {
    const std::ptrdiff_t row = std::ptrdiff_t(width) * channels;
    for (int y = 0; y < height / 2; ++y)
        std::swap_ranges(data.begin() + y * row, data.begin() + (y + 1) * row, data.begin() + (height - 1 - y) * row);
}

}  // namespace

ByteImage Renderer::read_colour(const Image& image) {
    ByteImage out{image.width, image.height, {}};
    out.data.resize(std::size_t(image.width) * std::size_t(image.height) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(image.texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(out.data.size()), out.data.data());
    flip_rows(out.data, out.width, out.height, 4);
    return out;
}

FloatImage Renderer::read_float(const Image& image, int channels) {
    FloatImage out{image.width, image.height, channels, {}};
    out.data.resize(std::size_t(image.width) * std::size_t(image.height) * std::size_t(channels));
    constexpr GLenum kFormats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    const GLenum format = kFormats[channels - 1];
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(image.texture, 0, format, GL_FLOAT, GLsizei(out.data.size() * sizeof(float)), out.data.data());
    flip_rows(out.data, out.width, out.height, channels);
    return out;
}

SurfaceIds Renderer::read_surface_ids(const Image& image) {
    SurfaceIds out{image.width, image.height, {}};
    out.data.resize(std::size_t(image.width) * std::size_t(image.height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(image.texture, 0, GL_RG_INTEGER, GL_UNSIGNED_INT, GLsizei(out.data.size() * sizeof(glm::uvec2)),
                      out.data.data());
    flip_rows(out.data, out.width, out.height, 1);
    return out;
}

FloatImage Renderer::read_shadow_map(int light, int face) {
    const Resources& r = impl_->resources;
    int layer = 0;
    bool found = false;
    for (std::size_t i = 0; i < r.fitted.size(); ++i) {
        if (!r.fitted[i].casts) continue;
        const int views = int(r.fitted[i].views.size());
        if (int(i) == light && face >= 0 && face < views) {
            layer += face;
            found = r.map_keys[i] != 0;
            break;
        }
        layer += views;
    }
    if (!found) throw Error(fmt::format("light {} has no shadow map image {}", light, face));
    const gl::Target& map = r.compared_map();
    const int n = map.width;
    FloatImage out{n, n, 1, std::vector<float>(std::size_t(n) * std::size_t(n))};
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    const GLenum format = map.format == GL_R32F ? GL_RED : GL_DEPTH_COMPONENT;
    glGetTextureSubImage(map.texture.id(), 0, 0, 0, layer, n, n, 1, format, GL_FLOAT,
                         GLsizei(out.data.size() * sizeof(float)), out.data.data());
    flip_rows(out.data, n, n, 1);
    return out;
}

FloatImage Renderer::read_map_view_depth() {
    const Resources& r = impl_->resources;
    if (r.shown.light < 0) throw Error("the last frame drew no map view to read from");
    if (r.shown.source == MapSource::Light) return read_shadow_map(r.shown.light, r.shown.face);
    const gl::Target& t = r.camera_depth;
    FloatImage out{t.width, t.height, 1, std::vector<float>(std::size_t(t.width) * std::size_t(t.height))};
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(t.texture.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, GLsizei(out.data.size() * sizeof(float)),
                      out.data.data());
    flip_rows(out.data, t.width, t.height, 1);
    return out;
}

}  // namespace si
