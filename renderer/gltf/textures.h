// Textures of a glTF file: requested by materials, decoded together at the end, dropped with a warning on errors.
#pragma once

#include <future>
#include <map>
#include <optional>
#include <tuple>

#include "renderer/gltf/buffers.h"
#include "renderer/gltf/image_decode.h"
#include "renderer/gltf/tinygltf_model.h"

namespace si::gltf {

/// Textures of one glTF file. Collects the textures that materials use, then decodes their images in parallel.
class Textures {
public:
    Textures(Context& context, const Json& root, const tinygltf::Model& model, Buffers& buffers, Scene& scene);
    /// Requests a glTF texture for a material. Returns its index in Scene::textures; -1, with a warning, when no
    /// readable image provides it. decode() decodes all requested textures later.
    /// @param srgb true for colours, false for data such as normals
    int use(int texture, bool srgb);
    /// Warns that a material's shadow is wrong because the image with its alpha channel is not read. Does nothing for
    /// an opaque material.
    /// @param material index in Scene::materials @param is_ktx2 true: the warning advises to convert KTX2 images
    void warn_lost_alpha(std::size_t material, bool is_ktx2);
    /// Returns true when a glTF texture has an image in the format KTX2 only, which this loader does not read.
    bool is_ktx2_alone(int texture) const;
    /// Decodes the images of all requested textures, in parallel. Textures whose images fail are removed from the scene
    /// and from its materials, with a warning.
    void decode();

private:
    /// Reason why a texture of the scene has no pixels.
    enum class Failure { None, Unreadable, Ktx2 };
    /// Requested texture whose image is still encoded.
    struct Job {
        int image = -1;
        std::size_t scene_texture = 0;
        bool says_webp = false;  ///< the glTF texture has EXT_texture_webp
    };
    /// Image that another thread or a child process decodes, with its encoded bytes.
    struct Decoding {
        Bytes storage;
        std::string error;
        std::size_t cost = 0;
        std::span<const std::uint8_t> webp;  ///< bytes of a WebP image, which decode_webp_images() decodes
        std::future<Image> image;  ///< invalid if `error` or `webp` is set; last: destroyed before the bytes it reads
    };
    /// Starts decoding a texture's image on another thread. A WebP image is only fetched; decode_webp_images() decodes
    /// it.
    Decoding start(const Job& job);
    /// Returns the index of the WebP image that EXT_texture_webp names for a glTF texture; nullopt without this
    /// extension.
    std::optional<int> webp_image(int texture) const;
    /// Returns the index of the image to decode for a glTF texture. Returns nullopt, with a warning, when the texture
    /// has no image in a format that is read.
    std::optional<int> readable_image(int texture);
    /// Decodes WebP images in several child processes at once. Returns the images in the order of `waiting`.
    std::vector<Image> decode_webp_images(const std::vector<Decoding>& waiting);
    /// Moves a decoded image into its texture of the scene. If decoding failed, warns with the reason and marks the
    /// texture for remove_failed().
    /// @param job request for the texture
    void keep(const Job& job, Image image);
    /// Finds the encoded bytes of a glTF image in a buffer view, a data URI or a file. Returns an error text; empty on
    /// success.
    /// @param image index in the file @param bytes receives the encoded bytes
    /// @param storage receives ownership of the bytes when they come from a file or data URI
    std::string fetch(int image, std::span<const std::uint8_t>& bytes, Bytes& storage);
    /// Removes the textures whose images could not be decoded from the scene and from its materials.
    void remove_failed();

    Context& context_;
    const Json& root_;
    const tinygltf::Model& model_;
    Buffers& buffers_;
    Scene& scene_;
    std::map<std::tuple<int, int, bool>, int> known_;  ///< index in Scene::textures, or -1, by image, sampler and srgb
    std::vector<Job> jobs_;
    std::vector<Failure> failures_;  ///< by texture of the scene
    std::size_t decoded_bytes_ = 0;  ///< size of all decoded textures
};

}  // namespace si::gltf
