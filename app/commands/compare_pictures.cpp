// Difference of two picture files as a person sees it.
#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/report/report.h"
#include "renderer/base/error.h"
#include "renderer/base/held_memory.h"
#include "renderer/base/regular_file.h"
#include "renderer/gltf/image_decode.h"
#include "renderer/gltf/image_faults.h"
#include "renderer/reference/flip.h"

namespace si {
namespace {

constexpr std::size_t kMaxPictureFileBytes = std::size_t{1} << 30;

/// Reads a PNG file. @throws Error that names the file
ByteImage read_picture(const std::string& path) {
    const ReadResult file = read_regular_file(path, kMaxPictureFileBytes);
    if (!file.error.empty()) throw Error(fmt::format("{}: {}; name a PNG file", path, file.error));
    // Two decoded pictures, their map and its picture take as much again.
    const std::uint64_t bytes = 2 * std::uint64_t(gltf::decoding_bytes(file.bytes.span())), free = available_memory();
    if (free > 0 && bytes > free)
        throw Error(fmt::format("{}: takes about {} of memory, and {} are free; compare smaller pictures", path,
                                bytes_text(bytes), bytes_text(free)));
    gltf::Image image = gltf::decode_image(file.bytes.span());
    if (image.error.empty()) image.error = gltf::checksum_fault(file.bytes.span());
    if (!image.error.empty()) throw Error(fmt::format("{}: {}; name a whole PNG file", path, image.error));
    return {image.width, image.height, std::move(image.rgba)};
}

}  // namespace

void run_compare_pictures(const ComparePicturesOptions& options) {
    if (!options.output.empty()) {
        require_output(options.output, "the heat map", {".png"});
        require_outputs_not_read(std::vector<std::filesystem::path>{options.output},
                                 std::vector<std::filesystem::path>{options.picture, options.other_picture});
    }
    const ByteImage a = read_picture(options.picture), b = read_picture(options.other_picture);
    if (a.width != b.width || a.height != b.height)
        throw Error(fmt::format("{} has {} x {} pixels, {} has {} x {}; draw both in one size (render --size)",
                                options.picture, a.width, a.height, options.other_picture, b.width, b.height));
    const Flip flip = flip_difference(a, b, options.pixels_per_degree);
    if (!options.output.empty()) write_png(options.output, flip_picture(flip.map));
    if (options.json) {
        const Json json = {{"format", "shadow-inspector-picture-difference"},
                           {"version", 1},
                           {"width", a.width},
                           {"height", a.height},
                           {"pixels_per_degree", options.pixels_per_degree},
                           {"flip", {{"mean", flip.mean}, {"max", flip.max}}}};
        fmt::print("{}", json_text(json));
        return;
    }
    fmt::print("FLIP mean {:.6f}, max {:.6f} ({} x {} pixels, {:g} pixels per degree)\n", flip.mean, flip.max, a.width,
               a.height, options.pixels_per_degree);
}

}  // namespace si
