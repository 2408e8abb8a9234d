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

/// Image of a texture as a PNG or JPEG file in memory.
struct EncodedImage {
    std::vector<std::uint8_t> bytes;  ///< a PNG or JPEG file
    bool masks = false;               ///< alpha is below 255 somewhere, and the material uses it as opacity
};

/// Reader of the texture images of a model, which lie in the model's file or below its folder.
class Images {
public:
    /// @param scene model with embedded images @param folder folder of the model; both must outlive this object
    Images(const aiScene& scene, ModelFolder& folder) : scene_(scene), folder_(folder) {}

    /// Returns the colour image of a texture; nothing, with a reason, if it cannot be read. PNG and JPEG files stay
    /// unchanged. Images of other formats become PNG files.
    /// @param path name of the image in the model
    /// @param why receives the reason of a failure, for people
    std::optional<EncodedImage> colour(const std::string& path, std::string& why) const;

    /// Returns a colour image as a PNG whose alpha channel is the opacity from a second image: the alpha of that image,
    /// or its brightness if it has no alpha. Returns nothing, with a reason, on failure.
    /// @param path colour image; empty: white
    /// @param opacity_path image of the opacity
    /// @param why receives the reason of a failure, for people
    std::optional<EncodedImage> masked(const std::string& path, const std::string& opacity_path,
                                       std::string& why) const;

private:
    /// Returns the content of one of the model's image files; nothing, with a reason in `why`, if there is none.
    std::optional<std::vector<std::uint8_t>> file(const std::string& path, std::string& why) const;

    const aiScene& scene_;
    ModelFolder& folder_;
};

}  // namespace si::assimp
