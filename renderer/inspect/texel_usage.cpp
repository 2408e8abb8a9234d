#include "renderer/inspect/texel_usage.h"

#include <algorithm>
#include <cmath>

#include "renderer/settings/filters.h"

namespace si {
namespace {

/// Sums over windows of `width` along one line of `n + width - 1` (or, wrapping round, `n`) values.
template <typename Get, typename Put>
void window_sums(int n, int width, bool wraps, Get get, Put put) {
    std::uint32_t sum = 0;
    if (wraps) {
        // Texel t is read by footprints that begin at t - width + 1 .. t, each counted once.
        const int window = std::min(width, n);
        for (int i = 0; i < window - 1; ++i) sum += get(n - 1 - i);
        for (int t = 0; t < n; ++t) {
            sum += get(t);
            put(t, sum);
            sum -= get((t - window + 1 + n) % n);
        }
        return;
    }
    for (int i = 0; i < width - 1; ++i) sum += get(i);
    for (int t = 0; t < n; ++t) {
        sum += get(t + width - 1);
        put(t, sum);
        sum -= get(t);
    }
}

}  // namespace

KernelFootprint kernel_footprint(float u, float v, MapSize size, double reach_texels) {
    // Float, as in the shaders. The clamp matters only far outside the map.
    const auto first = [&](float at, int side) {
        const float x = at * float(side) - float(reach_texels) + 0.5f;
        return int(std::floor(std::clamp(x, -1e9f, 1e9f)));
    };
    return {{first(u, size.width), first(v, size.height)}, std::max(1, int(std::lround(2 * reach_texels)))};
}

TexelUsage::TexelUsage(const FloatImage& map_coordinates, MapSize size, double reach_texels, MapWrap wrap, int layer)
    : size_(std::max(size.width, 1), std::max(size.height, 1)),
      width_(map_coordinates.width),
      repeats_(wrap == MapWrap::Repeat) {
    kernel_ = kernel_footprint(0, 0, size_, reach_texels).count;
    grid_ = repeats_ ? size_.sides() : size_.sides() + (kernel_ - 1);
    const std::size_t cells = std::size_t(grid_.x) * std::size_t(grid_.y);
    std::vector<std::uint32_t> cell_of(map_coordinates.data.size() / 4, UINT32_MAX);
    begin_.assign(cells + 1, 0);
    for (std::size_t i = 0; i < cell_of.size(); ++i) {
        const float* p = &map_coordinates.data[4 * i];
        if (!(p[3] > 0) || int(p[2]) != layer || !std::isfinite(p[0]) || !std::isfinite(p[1])) continue;
        glm::ivec2 cell = kernel_footprint(p[0], p[1], size_, reach_texels).first;
        if (repeats_) {
            cell = ((cell % size_.sides()) + size_.sides()) % size_.sides();
        } else {
            cell += kernel_ - 1;
            const bool misses = cell.x < 0 || cell.y < 0 || cell.x >= grid_.x || cell.y >= grid_.y;
            if (misses && wrap != MapWrap::Clamp) continue;
            cell = glm::clamp(cell, glm::ivec2(0), grid_ - 1);  // beyond it, only the outermost texel is read
        }
        cell_of[i] = std::uint32_t(cell.y) * std::uint32_t(grid_.x) + std::uint32_t(cell.x);
        ++begin_[cell_of[i] + 1];
    }
    for (std::size_t i = 0; i < cells; ++i) begin_[i + 1] += begin_[i];
    pixels_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < cell_of.size(); ++i)
        if (cell_of[i] != UINT32_MAX) pixels_[next[cell_of[i]]++] = std::uint32_t(i);
    count_texels();
}

void TexelUsage::count_texels() {
    const auto n = std::size_t(size_.width), side = std::size_t(grid_.x), rows_below = std::size_t(grid_.y);
    // Rows of footprints summed along x, then along y.
    std::vector<std::uint32_t> rows(rows_below * n);
    for (std::size_t y = 0; y < rows_below; ++y)
        window_sums(
            size_.width, kernel_, repeats_,
            [&](int x) { return begin_[y * side + std::size_t(x) + 1] - begin_[y * side + std::size_t(x)]; },
            [&](int x, std::uint32_t sum) { rows[y * n + std::size_t(x)] = sum; });
    counts_.resize(n * std::size_t(size_.height));
    for (std::size_t x = 0; x < n; ++x)
        window_sums(
            size_.height, kernel_, repeats_, [&](int y) { return rows[std::size_t(y) * n + x]; },
            [&](int y, std::uint32_t sum) { counts_[std::size_t(y) * n + x] = sum; });
}

double TexelUsage::utilisation() const {
    if (counts_.empty()) return 0;
    const auto read = std::count_if(counts_.begin(), counts_.end(), [](std::uint32_t c) { return c > 0; });
    return double(read) / double(counts_.size());
}

std::uint32_t TexelUsage::pixels(glm::ivec2 texel) const {
    if (texel.x < 0 || texel.y < 0 || texel.x >= size_.width || texel.y >= size_.height) return 0;
    return counts_[std::size_t(texel.y) * std::size_t(size_.width) + std::size_t(texel.x)];
}

std::uint32_t TexelUsage::max_pixels() const {
    return counts_.empty() ? 0 : *std::max_element(counts_.begin(), counts_.end());
}

FloatImage TexelUsage::counts() const {
    FloatImage image{size_.width, size_.height, 1, std::vector<float>(counts_.size())};
    for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x)
            image.data[std::size_t(size_.height - 1 - y) * std::size_t(size_.width) + std::size_t(x)] =
                float(pixels({x, y}));
    return image;
}

std::vector<glm::ivec2> TexelUsage::readers(glm::ivec2 texel) const {
    std::vector<glm::ivec2> out;
    if (pixels(texel) == 0) return out;
    glm::ivec2 window(kernel_);
    if (repeats_) window = glm::min(window, size_.sides());
    std::vector<std::uint32_t> found;
    for (int dy = 0; dy < window.y; ++dy)
        for (int dx = 0; dx < window.x; ++dx) {
            // Without wrapping, the grid begins kernel - 1 texels before the map.
            glm::ivec2 cell = texel + glm::ivec2(dx, dy);
            if (repeats_) cell = (texel - glm::ivec2(dx, dy) + size_.sides()) % size_.sides();
            const std::size_t i = std::size_t(cell.y) * std::size_t(grid_.x) + std::size_t(cell.x);
            found.insert(found.end(), pixels_.begin() + begin_[i], pixels_.begin() + begin_[i + 1]);
        }
    std::sort(found.begin(), found.end());
    for (const std::uint32_t p : found)
        out.emplace_back(int(p % std::uint32_t(width_)), int(p / std::uint32_t(width_)));
    return out;
}

double exact_utilisation(const FloatImage& texels_read) {
    if (texels_read.data.empty()) return 0;
    const auto read = std::count(texels_read.data.begin(), texels_read.data.end(), 1.f);
    return double(read) / double(texels_read.data.size());
}

TexelUsage texel_usage(const FloatImage& map_coordinates, const Settings& settings, MapSize size, int layer) {
    return TexelUsage(map_coordinates, size, reach_of(settings).read, settings.map.wrap, layer);
}

}  // namespace si
