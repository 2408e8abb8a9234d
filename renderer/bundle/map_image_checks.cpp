#include "renderer/bundle/map_image_checks.h"

#include <fmt/format.h>

#include "renderer/base/error.h"
#include "renderer/bundle/bundle.h"

namespace si {

void check_map_image_sides(std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1 || width > kMaxBundleImageSide || height > kMaxBundleImageSide)
        throw Error(fmt::format("{} × {} texels cannot be read; use 1 to {} texels a side", width, height,
                                kMaxBundleImageSide));
}

void check_map_image_numbers(std::int64_t width, std::int64_t height, int channels, std::size_t most) {
    if (std::size_t(width) * std::size_t(height) * std::size_t(channels) > most)
        throw Error(fmt::format("{} × {} texels of {} channels cannot be read; write the channel with the depths alone",
                                width, height, channels));
}

}  // namespace si
