#include "app/report/picture_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace si {
namespace {

constexpr int kGap = 2;  ///< pixels

/// Returns the share of source pixel `i` that lies within [from, to).
double overlap(int i, double from, double to) {
    return std::max(0.0, std::min(to, i + 1.0) - std::max(from, double(i)));
}

}  // namespace

ByteImage plain_image(int width, int height, std::uint8_t value) {
    return {width, height, std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height) * 4, value)};
}

void paste_image(ByteImage& to, const ByteImage& from, glm::ivec2 corner, int columns) {
    const int width = std::max(std::min({from.width, to.width - corner.x, columns}), 0);
    for (int y = 0; y < std::min(from.height, to.height - corner.y); ++y)
        std::copy_n(from.data.begin() + std::ptrdiff_t(y) * from.width * 4, width * 4,
                    to.data.begin() + (std::ptrdiff_t(corner.y + y) * to.width + corner.x) * 4);
}

ByteImage shrunk(const ByteImage& image, int width) {
    if (image.width <= width) return image;
    const double scale = double(image.width) / width;
    ByteImage out = plain_image(width, std::max(1, int(std::lround(image.height / scale))), 0);
    const double scale_y = double(image.height) / out.height;
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            const double left = x * scale, right = left + scale, top = y * scale_y, bottom = top + scale_y;
            double sum[4] = {}, area = 0;
            for (int sy = int(top); sy < std::min(int(std::ceil(bottom)), image.height); ++sy)
                for (int sx = int(left); sx < std::min(int(std::ceil(right)), image.width); ++sx) {
                    const double share = overlap(sx, left, right) * overlap(sy, top, bottom);
                    const std::uint8_t* p =
                        &image.data[(std::size_t(sy) * std::size_t(image.width) + std::size_t(sx)) * 4];
                    for (int c = 0; c < 4; ++c) sum[c] += share * p[c];
                    area += share;
                }
            for (int c = 0; c < 4; ++c)
                out.data[(std::size_t(y) * std::size_t(out.width) + std::size_t(x)) * 4 + std::size_t(c)] =
                    std::uint8_t(std::lround(sum[c] / area));
        }
    return out;
}

Settings settings_with_shadows_of(const Settings& shown, const Settings& other) {
    Settings out = other;
    out.scene = shown.scene;
    out.camera = shown.camera;
    out.view = shown.view;
    out.truth = shown.truth;
    return out;
}

ByteImage swipe_image(const ByteImage& a, const ByteImage& b, double at) {
    ByteImage out = b;
    const int line = std::clamp(int(std::lround(at * a.width)), 0, a.width);
    paste_image(out, a, {0, 0}, line);
    for (int x = std::max(line - 1, 0); x < std::min(line + 1, out.width) && line > 0 && line < out.width; ++x)
        for (int y = 0; y < out.height; ++y)
            std::fill_n(&out.data[(std::size_t(y) * std::size_t(out.width) + std::size_t(x)) * 4], 4,
                        std::uint8_t(255));
    return out;
}

ByteImage side_by_side_image(const ByteImage& a, const ByteImage& b) {
    ByteImage out = plain_image(a.width + kGap + b.width, std::max(a.height, b.height), 22);
    paste_image(out, a, {0, 0});
    paste_image(out, b, {a.width + kGap, 0});
    return out;
}

ByteImage difference_image(const ByteImage& a, const ByteImage& b) {
    ByteImage out = a;
    for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i)
        out.data[i] = i % 4 == 3 ? 255 : std::uint8_t(std::min(2 * std::abs(int(a.data[i]) - int(b.data[i])), 255));
    return out;
}

double mean_difference(const ByteImage& a, const ByteImage& b) {
    std::uint64_t sum = 0;
    const std::size_t bytes = std::min(a.data.size(), b.data.size());
    for (std::size_t i = 0; i < bytes; ++i)
        if (i % 4 != 3) sum += std::uint64_t(std::abs(int(a.data[i]) - int(b.data[i])));
    return bytes < 4 ? 0 : double(sum) / (255.0 * 3 * double(bytes / 4));
}

}  // namespace si
