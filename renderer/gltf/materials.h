// Materials of a glTF file, and the texture coordinates that their textures read.
#pragma once

#include "renderer/gltf/textures.h"

namespace si::gltf {

/// Texture coordinates that one texture reads: the set (texCoord) and its transform (KHR_texture_transform).
struct UvSource {
    int set = -1;  ///< index of TEXCOORD_n; -1: no texture
    glm::dvec2 offset{0}, scale{1};
    double rotation_rad = 0;

    bool operator==(const UvSource&) const = default;
    /// Returns true when texture coordinates are not transformed.
    bool is_plain() const { return offset == glm::dvec2(0) && scale == glm::dvec2(1) && rotation_rad == 0; }
    /// Applies KHR_texture_transform to texture coordinates in place.
    void apply(std::vector<glm::vec2>& uv) const;
};

/// Texture coordinate sets of a glTF material's base colour texture and normal texture.
struct MaterialUv {
    UvSource base_colour, normal;
};

/// Makes materials opaque that blend with alpha 1 at every texel and vertex, with a warning for each: blending with it
/// changes no pixel, and an opaque surface casts a shadow. Call after Textures::decode().
void make_full_blends_opaque(Context& context, const Json& root, Scene& scene);

/// Materials of one glTF file; textures are requested when a material is first used.
class Materials {
public:
    /// Copies all materials into the scene, still without textures.
    Materials(Context& context, const Json& root, const tinygltf::Model& model, Textures& textures, Scene& scene);
    /// Marks a glTF material (index; -1: the default one) as used, which requests its textures the first time. Returns
    /// the texture coordinates that it reads.
    const MaterialUv& use(int i);

private:
    /// Reads texCoord and KHR_texture_transform of a texture reference.
    UvSource uv_source(const Json& texture_info, const Place& place);

    Context& context_;
    const Json& root_;
    Textures& textures_;
    Scene& scene_;
    std::vector<std::optional<MaterialUv>> uv_;
    MaterialUv none_;
};

}  // namespace si::gltf
