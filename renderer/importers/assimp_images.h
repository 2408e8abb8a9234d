// Images of a model that Assimp has read, as bytes that a GLB can hold.
#pragma once

#include <assimp/scene.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/importers/assimp_files.h"

namespace si::assimp {

/// Encoded image of a texture.
struct EncodedImage {
    std::vector<std::uint8_t> bytes;  ///< a PNG or JPEG file
    bool masks = false;               ///< its alpha is below 255 somewhere, and the material uses it
};

/// Reader of the images that a model names, in its file or below its folder.
class Images {
public:
    /// @param scene model with embedded images; outlives this object @param folder outlives it too
    Images(const aiScene& scene, ModelFolder& folder) : scene_(scene), folder_(folder) {}

    /// Returns the image of a texture; nothing, with a reason, where it cannot be read.
    /// PNG and JPEG files stay as they are. Others are decoded and become PNG files.
    /// @param path name in the model @param why reason of a failure, for people
    std::optional<EncodedImage> colour(const std::string& path, std::string& why) const;

    /// Returns a PNG whose alpha is the opacity of a second texture: its alpha, or its brightness where it has none.
    /// @param path colour image; empty: white @param opacity_path image of the opacity
    std::optional<EncodedImage> masked(const std::string& path, const std::string& opacity_path,
                                       std::string& why) const;

private:
    /// Returns the bytes of an image file; nothing, with a reason, where there is none.
    std::optional<std::vector<std::uint8_t>> file(const std::string& path, std::string& why) const;

    const aiScene& scene_;
    ModelFolder& folder_;
};

}  // namespace si::assimp
