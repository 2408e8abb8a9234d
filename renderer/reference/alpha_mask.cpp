#include "renderer/reference/alpha_mask.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace si {
namespace {

/// Returns the texel that a wrap mode selects for an integer coordinate (OpenGL 4.5, table 8.20).
int wrapped(double texel, int size, TextureWrap wrap) {
    if (texel >= 0 && texel < size) return int(texel);
    if (wrap == TextureWrap::Clamp) return int(std::clamp(texel, 0.0, size - 1.0));
    const double period = wrap == TextureWrap::Mirror ? 2.0 * size : double(size);
    const double in_period = std::clamp(texel - period * std::floor(texel / period), 0.0, period - 1);
    return in_period < size ? int(in_period) : int(2.0 * size - 1 - in_period);
}

}  // namespace

AlphaTexture::AlphaTexture(const Texture& t)
    : width(t.width), height(t.height), wrap_s(t.wrap_s), wrap_t(t.wrap_t), nearest(t.nearest_mag) {
    alpha.resize(t.rgba.size() / 4);
    for (std::size_t i = 0; i < alpha.size(); ++i) alpha[i] = t.rgba[4 * i + 3];
    if (nearest) return;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto [least, most] =
                std::minmax({texel(x, y), texel(x + 1.0, y), texel(x, y + 1.0), texel(x + 1.0, y + 1.0)});
            bounds_.push_back({least, most});
        }
}

std::uint8_t AlphaTexture::texel(double x, double y) const {
    return alpha[std::size_t(wrapped(y, height, wrap_t)) * std::size_t(width) + std::size_t(wrapped(x, width, wrap_s))];
}

double AlphaTexture::sample(const glm::dvec2& uv) const {
    const double x = uv.x * width, y = uv.y * height;
    if (nearest) return texel(std::floor(x), std::floor(y)) / 255.0;
    const double x0 = std::floor(x - 0.5), y0 = std::floor(y - 0.5), fx = x - 0.5 - x0, fy = y - 0.5 - y0;
    const double top = (1 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0);
    const double bottom = (1 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1);
    return ((1 - fy) * top + fy * bottom) / 255.0;
}

bool AlphaTexture::reaches(const glm::dvec2& uv, double cutoff) const {
    const double x = uv.x * width - 0.5, y = uv.y * height - 0.5;
    if (!nearest && x >= 0 && y >= 0 && x < width && y < height) {
        const Bounds bounds = bounds_[std::size_t(y) * std::size_t(width) + std::size_t(x)];
        constexpr double kRounding = 1e-6;
        if (bounds.most < 255 * cutoff - kRounding) return false;
        if (bounds.least > 255 * cutoff + kRounding) return true;
    }
    return !(sample(uv) < cutoff);
}

AlphaMask::AlphaMask(const Mesh& mesh, const Material& material, double cutoff,
                     std::shared_ptr<const AlphaTexture> texture)
    : indices_(mesh.indices), texture_(std::move(texture)), base_(material.base_colour.a), cutoff_(cutoff) {
    if (texture_) uv_ = mesh.uv;
    if (texture_ && uv_.empty()) uv_.assign(mesh.positions.size(), glm::vec2(0));
    // Eight bits, as in the vertex buffer.
    for (const glm::vec4& c : mesh.colours)
        vertex_alpha_.push_back(std::uint8_t(std::lround(std::clamp(c.a, 0.f, 1.f) * 255.f)));
}

bool AlphaMask::is_solid(std::uint32_t triangle, double u, double v) const {
    const std::uint32_t* i = &indices_[3 * std::size_t(triangle)];
    const double w = 1 - u - v;
    double alpha = base_;
    if (!vertex_alpha_.empty())
        alpha *= (w * vertex_alpha_[i[0]] + u * vertex_alpha_[i[1]] + v * vertex_alpha_[i[2]]) / 255.0;
    if (!texture_) return !(alpha < cutoff_);
    if (!(alpha > 0)) return !(0 < cutoff_);
    return texture_->reaches(w * glm::dvec2(uv_[i[0]]) + u * glm::dvec2(uv_[i[1]]) + v * glm::dvec2(uv_[i[2]]),
                             cutoff_ / alpha);
}

void AlphaMask::add_content(Key& key) const {
    key.add(base_).add(cutoff_).add(uv_.size()).bytes(uv_.data(), uv_.size() * sizeof(glm::vec2));
    key.add(vertex_alpha_.size()).bytes(vertex_alpha_.data(), vertex_alpha_.size());
    key.add(texture_ != nullptr);
    if (!texture_) return;
    const AlphaTexture& t = *texture_;
    key.add(t.width).add(t.height).add(t.wrap_s).add(t.wrap_t).add(t.nearest);
    key.bytes(t.alpha.data(), t.alpha.size());
}

}  // namespace si
