#include "renderer/gltf/materials.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/printable.h"

namespace si::gltf {
namespace {

AlphaMode alpha_of(const std::string& mode) {
    if (mode == "MASK") return AlphaMode::Mask;
    return mode == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
}

Material material_of(const tinygltf::Material& from) {
    Material to;
    to.name = printable(from.name);
    const auto& colour = from.pbrMetallicRoughness.baseColorFactor;
    if (colour.size() == 4) to.base_colour = glm::vec4(glm::dvec4(colour[0], colour[1], colour[2], colour[3]));
    to.normal_scale = static_cast<float>(from.normalTexture.scale);
    to.alpha = alpha_of(from.alphaMode);
    to.alpha_cutoff = static_cast<float>(from.alphaCutoff);
    to.double_sided = from.doubleSided;
    return to;
}

bool read_pair(const Json& object, const char* key, glm::dvec2& out) {
    const auto it = object.find(key);
    if (it == object.end()) return true;
    if (!it->is_array() || it->size() != 2) return false;
    for (int i = 0; i < 2; ++i) {
        const Json& value = (*it)[std::size_t(i)];
        if (!is_number_within(value, -1e6, 1e6)) return false;
        out[i] = value.get<double>();
    }
    return true;
}

}  // namespace

void UvSource::apply(std::vector<glm::vec2>& uv) const {
    if (is_plain()) return;
    // KHR_texture_transform: translation * rotation * scale; the rotation is counter-clockwise with v downwards.
    const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
    for (glm::vec2& t : uv) {
        const glm::dvec2 p = glm::dvec2(t) * scale;
        t = glm::vec2(offset.x + c * p.x + s * p.y, offset.y - s * p.x + c * p.y);
    }
}

Materials::Materials(Context& context, const Json& root, const tinygltf::Model& model, Textures& textures, Scene& scene)
    : context_(context), root_(root), textures_(textures), scene_(scene), uv_(model.materials.size()) {
    scene_.materials.reserve(model.materials.size());
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        scene_.materials.push_back(material_of(model.materials[i]));
        scene_.materials.back().unlit = extension_of(root["materials"][i], "KHR_materials_unlit") != nullptr;
    }
}

UvSource Materials::uv_source(const Json& info, const Place& place) {
    UvSource out;
    out.set = info.value("texCoord", 0);
    const Json* transform = extension_of(info, "KHR_texture_transform");
    if (!transform) return out;
    UvSource changed = out;
    bool good = transform->is_object() && read_pair(*transform, "offset", changed.offset) &&
                read_pair(*transform, "scale", changed.scale);
    if (good && transform->contains("rotation")) {
        const Json& rotation = (*transform)["rotation"];
        good = is_number_within(rotation, -1e6, 1e6);
        if (good) changed.rotation_rad = rotation.get<double>();
    }
    if (good && transform->contains("texCoord")) {
        const Json& set = (*transform)["texCoord"];
        good = set.is_number_unsigned() && set.get<std::uint64_t>() < 64;
        if (good) changed.set = set.get<int>();
    }
    if (good) return changed;
    context_.warn(Place(place, "KHR_texture_transform"), "has invalid values; ignored");
    return out;
}

void make_full_blends_opaque(Context& context, const Json& root, Scene& scene) {
    constexpr float kFull = 254.f / 255;
    std::vector<float> vertex_alpha(scene.materials.size(), 2);  // the least one; 2: no mesh has the material
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.material < 0 || scene.materials[std::size_t(mesh.material)].alpha != AlphaMode::Blend) continue;
        float& least = vertex_alpha[std::size_t(mesh.material)];
        least = std::min(least, 1.f);
        for (const glm::vec4& colour : mesh.colours) least = colour.a < least ? colour.a : least;
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        if (material.alpha != AlphaMode::Blend || vertex_alpha[i] > 1) continue;
        const bool has_texture =
            member(member(&root["materials"][i], "pbrMetallicRoughness"), "baseColorTexture") != nullptr;
        std::uint8_t texel_alpha = 255;
        if (material.base_colour_texture >= 0) {
            const auto& rgba = scene.textures[std::size_t(material.base_colour_texture)].rgba;
            for (std::size_t at = 3; at < rgba.size(); at += 4) texel_alpha = std::min(texel_alpha, rgba[at]);
        } else if (has_texture) {
            continue;  // its alpha is unknown
        }
        if (!(material.base_colour.a * (float(texel_alpha) / 255) * vertex_alpha[i] >= kFull)) continue;
        material.alpha = AlphaMode::Opaque;
        context.warn(Place("materials", i), "alphaMode is BLEND with alpha 1 everywhere; drawn and cast as opaque");
    }
}

const MaterialUv& Materials::use(int i) {
    if (i < 0) return none_;
    const auto at = std::size_t(i);
    if (uv_[at]) return *uv_[at];
    MaterialUv uv;
    const Json& json = root_["materials"][at];
    const Place place("materials", i);
    Material& material = scene_.materials[at];
    if (const Json* info = member(member(&json, "pbrMetallicRoughness"), "baseColorTexture")) {
        const int texture = (*info)["index"].get<int>();
        material.base_colour_texture = textures_.use(texture, true);
        if (material.base_colour_texture >= 0)
            uv.base_colour = uv_source(*info, Place(place, "baseColorTexture"));
        else
            textures_.warn_lost_alpha(at, textures_.is_ktx2_alone(texture));
    }
    if (const Json* info = member(&json, "normalTexture")) {
        material.normal_texture = textures_.use((*info)["index"].get<int>(), false);
        if (material.normal_texture >= 0) uv.normal = uv_source(*info, Place(place, "normalTexture"));
    }
    return *(uv_[at] = uv);
}

}  // namespace si::gltf
