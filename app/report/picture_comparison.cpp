#include "app/report/picture_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace si {
namespace {

constexpr int kGap = 2;  ///< pixels

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
