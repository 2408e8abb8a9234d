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

/// Textures of one glTF file: collects the textures that materials use, then decodes their images in parallel.
class Textures {
public:
    Textures(Context& context, const Json& root, const tinygltf::Model& model, Buffers& buffers, Scene& scene);
    /// Requests a glTF texture. Returns its index in the scene; -1, with a warning, when it cannot be shown.
    /// @param srgb true for colours, false for data such as normals
    int use(int texture, bool srgb);
    /// Warns that the shadow of a material is wrong, because the image that holds its alpha is not read.
    /// @param material index; nothing happens for an opaque one @param is_ktx2 true where it can be converted
    void warn_lost_alpha(std::size_t material, bool is_ktx2);
    /// Returns true when a glTF texture has no other image than a KTX2 one.
    bool is_ktx2_alone(int texture) const;
    /// Decodes all requested textures on all processors. Textures that fail are removed from the scene and its
    /// materials.
    void decode();

private:
    /// Reason why a texture of the scene has no pixels.
    enum class Failure { None, Unreadable, Ktx2 };
    /// A requested texture whose image has to be decoded.
    struct Job {
        int image = -1;
        std::size_t scene_texture = 0;
        bool says_webp = false;  ///< its texture has EXT_texture_webp
    };
    /// An image that another thread decodes, with its encoded bytes.
    struct Decoding {
        Bytes storage;
        std::string error;
        std::size_t cost = 0;
        std::span<const std::uint8_t> webp;  ///< bytes of a WebP image, which decode_webp_images() decodes
        std::future<Image> image;  ///< valid without `error` and `webp`; last, so that it ends before its bytes do
    };
    /// Starts decoding the image of a texture on another thread.
    Decoding start(const Job& job);
    /// Returns the image of a glTF texture by EXT_texture_webp; nothing where it has none.
    std::optional<int> webp_image(int texture) const;
    /// Returns the image index of a glTF texture; nothing when only an extension that is not read provides one.
    std::optional<int> readable_image(int texture);
    /// Decodes WebP images in child processes, several at once. Returns them in the order of `waiting`.
    std::vector<Image> decode_webp_images(const std::vector<Decoding>& waiting);
    /// Keeps a decoded image in its texture. If decoding failed, warns with the reason and sets the Failure of the
    /// texture.
    void keep(const Job& job, Image image);
    /// Finds the encoded bytes of a glTF image. Returns an error text, empty on success.
    /// @param storage owns the bytes when they come from a file or data URI
    std::string fetch(int image, std::span<const std::uint8_t>& bytes, Bytes& storage);
    /// Removes textures that could not be decoded from the scene and its materials.
    void remove_failed();

    Context& context_;
    const Json& root_;
    const tinygltf::Model& model_;
    Buffers& buffers_;
    Scene& scene_;
    std::map<std::tuple<int, int, bool>, int> known_;  ///< image, sampler, srgb
    std::vector<Job> jobs_;
    std::vector<Failure> failures_;  ///< by texture of the scene
    std::size_t decoded_bytes_ = 0;  ///< of all textures
};

}  // namespace si::gltf
