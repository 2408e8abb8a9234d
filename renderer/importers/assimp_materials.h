// Materials of a model that Assimp has read, written into a GLB.
#pragma once

#include <assimp/scene.h>

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "renderer/importers/assimp_images.h"
#include "renderer/importers/glb_writer.h"

namespace si::assimp {

/// Writer of the materials of an Assimp model into a GLB. Materials that use an image in the same way share one
/// texture.
class Materials {
public:
    /// @param notes receives a sentence for each texture that cannot be read
    Materials(const aiScene& scene, ModelFolder& folder, GlbWriter& glb, std::vector<std::string>& notes)
        : scene_(scene), images_(scene, folder), glb_(glb), notes_(notes) {}

    /// Writes all materials of the model into the GLB, in the same order, so that each keeps its index.
    void write();

private:
    /// Texture of a model's material, as Assimp names it.
    struct Named {
        std::string path;  ///< empty: none
        int uv = 0;        ///< channel of texture coordinates
        aiTextureMapMode wrap[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    };
    /// Texture of an Assimp model, written into the GLB: its index, and whether its alpha masks.
    struct Written {
        int texture = -1;  ///< -1: none
        bool masks = false;
    };
    /// Returns the first texture of a material with one of the given texture types, tried in order. Named::path is
    /// empty if the material has no such texture.
    static Named named(const aiMaterial& material, std::initializer_list<aiTextureType> types);
    /// Writes a texture with its image and sampler into the GLB; later calls with equal arguments return the same
    /// texture. Adds a note for an image that cannot be read.
    /// @param opacity_path image whose opacity becomes the alpha of the texture; empty: none
    /// @param material_name name of the material, for the note
    Written texture(const Named& colour, const std::string& opacity_path, const std::string& material_name);
    /// Converts a material of Assimp to a glTF material, and writes its textures.
    nlohmann::json material(const aiMaterial& from);

    const aiScene& scene_;
    Images images_;
    GlbWriter& glb_;
    std::vector<std::string>& notes_;
    std::map<std::tuple<std::string, std::string, int, int>, Written> written_;
};

}  // namespace si::assimp
