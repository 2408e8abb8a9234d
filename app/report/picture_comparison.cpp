#include "app/report/picture_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace si {
namespace {

constexpr int kGap = 2;  ///< pixels

void copy_columns(ByteImage& to, int at, const ByteImage& from, int first, int count) {
    for (int y = 0; y < std::min(to.height, from.height); ++y)
        std::copy_n(&from.data[(std::size_t(y) * std::size_t(from.width) + std::size_t(first)) * 4], count * 4,
                    &to.data[(std::size_t(y) * std::size_t(to.width) + std::size_t(at)) * 4]);
}

}  // namespace

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
    if (line > 0) copy_columns(out, 0, a, 0, line);
    for (int x = std::max(line - 1, 0); x < std::min(line + 1, out.width) && line > 0 && line < out.width; ++x)
        for (int y = 0; y < out.height; ++y)
            std::fill_n(&out.data[(std::size_t(y) * std::size_t(out.width) + std::size_t(x)) * 4], 4,
                        std::uint8_t(255));
    return out;
}

ByteImage side_by_side_image(const ByteImage& a, const ByteImage& b) {
    ByteImage out{a.width + kGap + b.width, std::max(a.height, b.height), {}};
    out.data.assign(std::size_t(out.width) * std::size_t(out.height) * 4, 22);
    copy_columns(out, 0, a, 0, a.width);
    copy_columns(out, a.width + kGap, b, 0, b.width);
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
