#include "renderer/gltf/webp.h"

#include <fmt/format.h>
#include <webp/decode.h>

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/foreign/pack.h"

namespace si::gltf {
namespace {

constexpr std::size_t kMaxAnswerBytes = std::size_t{256} << 20;
constexpr std::size_t kMaxRequestBytes = std::size_t{64} << 20;
constexpr std::uint64_t kBytesPerPixel = 12;  ///< while an image is decoded, passed on and kept

/// Decodes an image. Returns the reason of a failure, else an empty text.
std::string decode(std::span<const std::uint8_t> bytes, std::uint64_t max_bytes, std::uint64_t& width,
                   std::uint64_t& height, std::vector<std::uint8_t>& rgba) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK || features.width <= 0 ||
        features.height <= 0)
        return "not a WebP image, or damaged";
    if (features.has_animation) return "an animated WebP image, which no texture can be";
    width = std::uint64_t(features.width);
    height = std::uint64_t(features.height);
    if (const std::uint64_t cost = width * height * kBytesPerPixel; cost > max_bytes)
        return fmt::format("the image takes {} MiB to decode, at most {} are allowed; use a smaller one", cost >> 20,
                           max_bytes >> 20);
    rgba.resize(std::size_t(width * height * 4));
    if (!WebPDecodeRGBAInto(bytes.data(), bytes.size(), rgba.data(), rgba.size(), int(width) * 4))
        return "a WebP image that is cut or damaged";
    return "";
}

std::vector<std::uint8_t> run_job(std::span<const std::uint8_t> request, const std::function<void(double)>& progress,
                                  int) {
    return decode_packed_webp(request, progress);
}

/// Reads the images of an answer and appends them to `out`.
void read_answer(std::span<const std::uint8_t> answer, std::size_t max_images, std::atomic<std::size_t>& bytes_left,
                 std::vector<Image>& out) {
    PackReader in(answer);
    for (std::size_t i = 0; i < max_images && !in.at_end(); ++i) {
        Image image;
        image.error = in.text();
        if (image.error.empty()) {
            const std::uint64_t width = in.number(), height = in.number();
            const auto rgba = in.block();
            constexpr std::uint64_t kMaxSide = 16384;  // of the format
            if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide || rgba.size() != width * height * 4)
                throw Error("the WebP decoder returns an image of a wrong size");
            std::size_t left = bytes_left;
            while (left >= rgba.size() && !bytes_left.compare_exchange_weak(left, left - rgba.size())) {
            }
            if (left < rgba.size()) {
                image.error = "all textures together exceed 4 GiB";
            } else {
                image.width = int(width);
                image.height = int(height);
                image.rgba.assign(rgba.begin(), rgba.end());
            }
        }
        out.push_back(std::move(image));
    }
}

}  // namespace

constinit const ForeignJob kWebpJob = {"webp", "the WebP decoder", run_job};

bool is_webp(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 12));
    return text.size() == 12 && text.substr(0, 4) == "RIFF" && text.substr(8, 4) == "WEBP";
}

std::vector<std::uint8_t> pack_webp(std::span<const std::span<const std::uint8_t>> images,
                                    std::size_t max_image_bytes) {
    PackWriter out;
    out.number(max_image_bytes);
    for (const auto& image : images) out.block(image);
    return std::move(out.bytes());
}

std::vector<std::uint8_t> decode_packed_webp(std::span<const std::uint8_t> request,
                                             const std::function<void(double)>& progress) {
    PackReader in(request);
    PackWriter out;
    const std::uint64_t max_bytes = in.number();
    while (!in.at_end() && out.bytes().size() < kMaxAnswerBytes) {
        std::uint64_t width = 0, height = 0;
        std::vector<std::uint8_t> rgba;
        const std::string error = decode(in.block(), max_bytes, width, height, rgba);
        out.block(std::string_view(error));
        if (error.empty()) {
            out.number(width);
            out.number(height);
            out.block(rgba);
        }
        progress(0);
    }
    return std::move(out.bytes());
}

std::vector<Image> decode_webp(std::span<const std::span<const std::uint8_t>> images, std::size_t max_image_bytes,
                               std::atomic<std::size_t>& bytes_left, const std::atomic<bool>& stop) {
    std::vector<Image> out;
    bool one_by_one = false;  // after a crash, so that it costs one image
    while (out.size() < images.size()) {
        const auto rest = images.subspan(out.size());
        std::size_t count = 0, bytes = 0;
        while (count < rest.size() && (count == 0 || (!one_by_one && bytes + rest[count].size() <= kMaxRequestBytes)))
            bytes += rest[count++].size();
        try {
            const auto answer = run_foreign_job(kWebpJob, pack_webp(rest.first(count), max_image_bytes), {}, nullptr,
                                                [&](double) { return !stop; });
            const std::size_t before = out.size();
            read_answer(answer, count, bytes_left, out);
            if (out.size() == before) throw Error("the WebP decoder returns no image");
        } catch (const Error& error) {
            if (stop) throw;
            if (count == 1) out.push_back({0, 0, {}, error.what()});
            one_by_one = true;
        }
    }
    return out;
}

}  // namespace si::gltf
