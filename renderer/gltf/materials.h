// Materials, and which texture coordinates of a mesh their textures read.
#pragma once

#include "renderer/gltf/textures.h"

namespace si::gltf {

/// KHR_texture_transform and texCoord of one texture reference; set -1: no texture.
struct UvSource {
    int set = -1;
    glm::dvec2 offset{0}, scale{1};
    double rotation_rad = 0;

    bool operator==(const UvSource&) const = default;
    bool is_plain() const { return offset == glm::dvec2(0) && scale == glm::dvec2(1) && rotation_rad == 0; }
    void apply(std::vector<glm::vec2>& uv) const;
};

struct MaterialUv {
    UvSource base_colour, normal;
};

class Materials {
public:
    /// Copies all materials into the scene, still without textures.
    Materials(Context& context, const Json& root, const tinygltf::Model& model, Textures& textures, Scene& scene);
    /// Where material `i` (-1: the default one) reads its coordinates; on first use asks for its textures.
    const MaterialUv& use(int i);

private:
    UvSource uv_source(const Json& texture_info, const Place& place);

    Context& context_;
    const Json& root_;
    const tinygltf::Model& model_;
    Textures& textures_;
    Scene& scene_;
    std::vector<std::optional<MaterialUv>> uv_;
    MaterialUv none_;
};

}  // namespace si::gltf
