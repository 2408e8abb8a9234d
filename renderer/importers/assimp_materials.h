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

/// Writer of the materials of one model. Textures are shared between materials that use them alike.
class Materials {
public:
    /// @param notes receives a sentence for each texture that cannot be read
    Materials(const aiScene& scene, ModelFolder& folder, GlbWriter& glb, std::vector<std::string>& notes)
        : scene_(scene), images_(scene, folder), glb_(glb), notes_(notes) {}

    /// Writes all materials, so that a material keeps its index.
    void write();

private:
    /// Texture of a material, as Assimp names it.
    struct Named {
        std::string path;  ///< empty: none
        int uv = 0;        ///< channel of texture coordinates
        aiTextureMapMode wrap[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    };
    /// Texture in the GLB.
    struct Written {
        int texture = -1;  ///< -1: none
        bool masks = false;
    };
    static Named named(const aiMaterial& material, std::initializer_list<aiTextureType> types);
    Written texture(const Named& colour, const std::string& opacity_path, const std::string& material_name);
    nlohmann::json material(const aiMaterial& from);

    const aiScene& scene_;
    Images images_;
    GlbWriter& glb_;
    std::vector<std::string>& notes_;
    std::map<std::tuple<std::string, std::string, int, int>, Written> written_;
};

}  // namespace si::assimp
