// Textures of a glTF file: requested by materials, decoded together at the end, dropped with a warning on errors.
#pragma once

#include <future>
#include <map>
#include <optional>
#include <tuple>

#include "renderer/gltf/buffers.h"
#include "renderer/gltf/tinygltf_model.h"

namespace si::gltf {

/// Decoded image with 8-bit RGBA pixels, or the reason why it could not be decoded.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    std::string error;  ///< empty: decoded
};

/// Decodes a PNG or JPEG file in memory to RGBA8 (stb_image). Failures are reported in Image::error.
Image decode_image(std::span<const std::uint8_t> bytes);
/// Estimates the peak memory of decode_image() in bytes from the image's header; 0 when the header is unreadable.
std::size_t decoding_bytes(std::span<const std::uint8_t> bytes);

/// Textures of one glTF file: collects the textures that materials use, then decodes their images in parallel.
class Textures {
public:
    Textures(Context& context, const Json& root, const tinygltf::Model& model, Buffers& buffers, Scene& scene);
    /// Requests a glTF texture. Returns its index in the scene; -1, with a warning, when it cannot be shown.
    /// @param srgb true for colours, false for data such as normals
    int use(int texture, bool srgb);
    /// Decodes all requested textures on all processors. Textures that fail are removed from the scene and its
    /// materials.
    void decode();

private:
    /// A requested texture whose image has to be decoded.
    struct Job {
        int image = -1;
        std::size_t scene_texture = 0;
    };
    /// An image that another thread decodes, with its encoded bytes.
    struct Decoding {
        Bytes storage;
        std::string error;
        std::size_t cost = 0;
        std::future<Image> image;  ///< valid when `error` is empty; last, so that it ends before its bytes do
    };
    /// Starts decoding the image of a texture on another thread.
    Decoding start(const Job& job);
    /// Returns the image index of a glTF texture; nothing when only an extension that is not read provides one.
    std::optional<int> readable_image(int texture);
    /// Finds the encoded bytes of a glTF image. Returns an error text, empty on success.
    /// @param storage owns the bytes when they come from a file or data URI
    std::string fetch(int image, std::span<const std::uint8_t>& bytes, Bytes& storage);
    /// Removes textures that could not be decoded from the scene and its materials. @param failed flags by texture:
    /// true where it failed
    void remove_failed(const std::vector<char>& failed);

    Context& context_;
    const Json& root_;
    const tinygltf::Model& model_;
    Buffers& buffers_;
    Scene& scene_;
    std::map<std::tuple<int, int, bool>, int> known_;  ///< image, sampler, srgb
    std::vector<Job> jobs_;
};

}  // namespace si::gltf
