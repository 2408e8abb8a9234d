// Textures and their images: chosen as materials ask for them, decoded together at the end, dropped with a warning
// when they cannot be shown.
#pragma once

#include <future>
#include <map>
#include <optional>
#include <tuple>

#include "renderer/gltf/buffers.h"
#include "renderer/gltf/tinygltf_model.h"

namespace si::gltf {

struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    std::string error;  ///< empty: decoded
};

/// PNG or JPEG to RGBA8, by stb_image.
Image decode_image(std::span<const std::uint8_t> bytes);
/// Memory that decode_image() takes at its peak, by the image's header alone; 0 when that cannot be read.
std::size_t decoding_bytes(std::span<const std::uint8_t> bytes);

class Textures {
public:
    Textures(Context& context, const Json& root, const tinygltf::Model& model, Buffers& buffers, Scene& scene);
    /// The scene's texture for glTF texture `texture`; -1, with a warning, when none can be shown.
    int use(int texture, bool srgb);
    /// Decodes what was asked for, on all processors; removes those that fail from the scene and its materials.
    void decode();

private:
    struct Job {
        int image = -1;
        std::size_t scene_texture = 0;
    };
    struct Decoding {
        Bytes storage;
        std::string error;
        std::size_t cost = 0;
        std::future<Image> image;  ///< valid when `error` is empty; last, so that it ends before its bytes do
    };
    Decoding start(const Job& job);
    /// The image that is readable here: the source, or nothing when only an extension has one.
    std::optional<int> readable_image(int texture);
    /// Encoded bytes of an image; a reason instead when there are none.
    std::string fetch(int image, std::span<const std::uint8_t>& bytes, Bytes& storage);
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
