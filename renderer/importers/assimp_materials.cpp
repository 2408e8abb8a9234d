#include "renderer/importers/assimp_materials.h"

#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace si::assimp {
namespace {

using nlohmann::json;

// Numbers that the glTF 2.0 specification takes from OpenGL.
constexpr int kRepeatWrap = 10497, kClampWrap = 33071, kMirrorWrap = 33648;

int wrap_of(aiTextureMapMode mode) {
    if (mode == aiTextureMapMode_Mirror) return kMirrorWrap;
    return mode == aiTextureMapMode_Wrap ? kRepeatWrap : kClampWrap;
}

float in_unit_range(float value) {
    return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f;
}

}  // namespace

Materials::Named Materials::named(const aiMaterial& material, std::initializer_list<aiTextureType> types) {
    for (const aiTextureType type : types) {
        Named out;
        aiString path;
        unsigned uv = 0;
        if (material.GetTexture(type, 0, &path, nullptr, &uv, nullptr, nullptr, out.wrap) != aiReturn_SUCCESS) continue;
        if (path.length == 0) continue;
        out.path.assign(path.data, path.length);
        out.uv = uv < AI_MAX_NUMBER_OF_TEXTURECOORDS ? int(uv) : 0;
        return out;
    }
    return {};
}

Materials::Written Materials::texture(const Named& colour, const std::string& opacity_path,
                                      const std::string& material_name) {
    const int wrap_u = wrap_of(colour.wrap[0]), wrap_v = wrap_of(colour.wrap[1]);
    const auto key = std::tuple(colour.path, opacity_path, wrap_u, wrap_v);
    if (const auto known = written_.find(key); known != written_.end()) return known->second;
    Written& out = written_[key];
    std::string why;
    const auto image =
        opacity_path.empty() ? images_.colour(colour.path, why) : images_.masked(colour.path, opacity_path, why);
    if (!image) {
        notes_.push_back(fmt::format("material \"{}\": its texture \"{}\" is left out: {}", material_name,
                                     colour.path.empty() ? opacity_path : colour.path, why));
        return out;
    }
    const bool png = image->bytes.size() > 1 && image->bytes[1] == 'P';
    const std::string name = colour.path.substr(colour.path.find_last_of("/\\") + 1);
    const int source = glb_.append(
        "images",
        {{"name", name}, {"mimeType", png ? "image/png" : "image/jpeg"}, {"bufferView", glb_.add_view(image->bytes)}});
    const int sampler = glb_.append("samplers", {{"wrapS", wrap_u}, {"wrapT", wrap_v}});
    out.texture = glb_.append("textures", {{"source", source}, {"sampler", sampler}});
    out.masks = image->masks;
    return out;
}

json Materials::material(const aiMaterial& from) {
    const aiString name = const_cast<aiMaterial&>(from).GetName();
    aiColor4D colour(1, 1, 1, 1);
    if (from.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    float opacity = 1;
    from.Get(AI_MATKEY_OPACITY, opacity);
    // Exporters disagree about 0: an invisible surface is hardly meant.
    const float alpha = in_unit_range(opacity) > 0 ? in_unit_range(opacity) : 1.0f;
    int two_sided = 0;
    from.Get(AI_MATKEY_TWOSIDED, two_sided);

    json out = {{"name", std::string(name.data, name.length)}, {"doubleSided", two_sided != 0}};
    json& surface = out["pbrMetallicRoughness"] = {{"metallicFactor", 0}};
    const Named base = named(from, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    const Named mask = named(from, {aiTextureType_OPACITY});
    if (!base.path.empty() || !mask.path.empty()) {
        const Named& place = base.path.empty() ? mask : base;
        Named shown = place;
        shown.path = base.path;
        const Written written = texture(shown, mask.path, out["name"]);
        if (written.texture >= 0) {
            surface["baseColorTexture"] = {{"index", written.texture}, {"texCoord", place.uv}};
            // A texture takes the place of the colour in most formats.
            if (!base.path.empty()) colour = {1, 1, 1, 1};
            if (written.masks) out["alphaMode"] = "MASK";
        }
    }
    surface["baseColorFactor"] = {in_unit_range(colour.r), in_unit_range(colour.g), in_unit_range(colour.b), alpha};
    if (alpha < 1) out["alphaMode"] = "BLEND";
    if (const Named normal = named(from, {aiTextureType_NORMALS}); !normal.path.empty())
        if (const Written written = texture(normal, {}, out["name"]); written.texture >= 0)
            out["normalTexture"] = {{"index", written.texture}, {"texCoord", normal.uv}};
    return out;
}

void Materials::write() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) glb_.append("materials", material(*scene_.mMaterials[i]));
}

}  // namespace si::assimp
