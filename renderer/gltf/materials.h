// Materials of a glTF file, and the texture coordinates that their textures read.
#pragma once

#include "renderer/gltf/textures.h"

namespace si::gltf {

/// Source of the texture coordinates of one texture: the vertex attribute (texCoord) and the transform
/// (KHR_texture_transform).
struct UvSource {
    int set = -1;  ///< index of TEXCOORD_n; -1: no texture
    glm::dvec2 offset{0}, scale{1};
    double rotation_rad = 0;

    bool operator==(const UvSource&) const = default;
    /// Returns true when texture coordinates are not transformed.
    bool is_plain() const { return offset == glm::dvec2(0) && scale == glm::dvec2(1) && rotation_rad == 0; }
    /// Transforms texture coordinates in place by the offset, rotation and scale of KHR_texture_transform.
    void apply(std::vector<glm::vec2>& uv) const;
};

/// Texture coordinate sources of a glTF material, for its base colour texture and its normal texture.
struct MaterialUv {
    UvSource base_colour, normal;
};

/// Makes a material with alpha blending opaque if its alpha is 1 at every texel and vertex, with a warning. Blending
/// would change no pixel there, and blended surfaces cast no shadow by default. Call after Textures::decode().
/// @param root the glTF document
void make_full_blends_opaque(Context& context, const Json& root, Scene& scene);

/// Materials of one glTF file. The first use of a material requests its textures.
class Materials {
public:
    /// Copies all materials into the scene, still without textures.
    Materials(Context& context, const Json& root, const tinygltf::Model& model, Textures& textures, Scene& scene);
    /// Returns the texture coordinate sources of a glTF material. The first call for a material requests its textures.
    /// @param i index of the material; -1: the default material
    const MaterialUv& use(int i);

private:
    /// Reads texCoord and KHR_texture_transform of a material's reference to a texture (textureInfo). An invalid
    /// transform is ignored with a warning.
    UvSource uv_source(const Json& texture_info, const Place& place);

    Context& context_;
    const Json& root_;
    Textures& textures_;
    Scene& scene_;
    std::vector<std::optional<MaterialUv>> uv_;
    MaterialUv none_;
};

}  // namespace si::gltf
