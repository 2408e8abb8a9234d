#include "app/sweep/pictures.h"

#include <fmt/format.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/error.h"

namespace si {
namespace {

/// Returns the share of source pixel `i` that lies within [from, to).
double overlap(int i, double from, double to) {
    return std::max(0.0, std::min(to, i + 1.0) - std::max(from, double(i)));
}

}  // namespace

ByteImage shrunk(const ByteImage& image, int width) {
    if (image.width <= width) return image;
    const double scale = double(image.width) / width;
    ByteImage out;
    out.width = width;
    out.height = std::max(1, int(std::lround(image.height / scale)));
    out.data.resize(std::size_t(out.width) * std::size_t(out.height) * 4);
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

std::string jpg_bytes(const ByteImage& image, int quality) {
    std::string bytes;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), std::size_t(size));
    };
    if (!stbi_write_jpg_to_func(append, &bytes, image.width, image.height, 4, image.data.data(), quality))
        throw Error(fmt::format("a picture of {} x {} pixels could not be encoded as JPEG", image.width, image.height));
    return bytes;
}

}  // namespace si
