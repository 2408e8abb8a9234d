#include "renderer/gltf/not_written.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "renderer/base/printable.h"
#include "renderer/gltf/extras.h"

namespace si::gltf {
namespace {

/// Returns true if any element of the file's array `list` satisfies `test`.
bool any_of(const Json& root, const char* list, const auto& test) {
    const Json* const all = member(&root, list);
    return all && all->is_array() &&
           std::ranges::any_of(*all, [&](const Json& element) { return element.is_object() && test(element); });
}

bool has_any(const Json& object, std::initializer_list<const char*> keys) {
    return std::ranges::any_of(keys, [&](const char* key) { return object.contains(key); });
}

bool has_foreign_extras(const Json& object) {
    const Json* const extras = member(&object, "extras");
    return extras && !(extras->is_object() && extras->size() == 1 && extras->contains(kExtrasKey));
}

std::string unwritten_extensions(const Json& root) {
    constexpr std::array<std::string_view, 2> kWritten = {"KHR_lights_punctual", "KHR_materials_unlit"};
    std::string names;
    const Json* const used = member(&root, "extensionsUsed");
    if (!used || !used->is_array()) return names;
    for (const Json& name : *used) {
        if (!name.is_string() || std::ranges::find(kWritten, name.get_ref<const std::string&>()) != kWritten.end())
            continue;
        names += (names.empty() ? "" : ", ") + printable(name.get_ref<const std::string&>(), 60);
    }
    return printable(names, 400);
}

std::string unwritten_material_parts(const Json& root) {
    std::string names;
    const auto add = [&](const char* name, const auto& test) {
        if (any_of(root, "materials", test)) names += (names.empty() ? "" : ", ") + std::string(name);
    };
    add("metallic and roughness", [](const Json& m) {
        const Json* const pbr = member(&m, "pbrMetallicRoughness");
        if (!pbr || !pbr->is_object()) return true;
        const auto is = [&](const char* key, double written) {
            const Json* const factor = member(pbr, key);
            return factor && factor->is_number() && factor->get<double>() == written;
        };
        return pbr->contains("metallicRoughnessTexture") || !is("metallicFactor", 0) || !is("roughnessFactor", 0.8);
    });
    add("emission", [](const Json& m) { return has_any(m, {"emissiveFactor", "emissiveTexture"}); });
    add("occlusion", [](const Json& m) { return m.contains("occlusionTexture"); });
    return names;
}

}  // namespace

std::vector<std::string> parts_not_written(const Json& root) {
    std::vector<std::string> notes;
    if (const std::string names = unwritten_extensions(root); !names.empty())
        notes.push_back(
            fmt::format("extensions are dropped: {}; what they change in geometry and coordinates is baked", names));
    if (const std::string names = unwritten_material_parts(root); !names.empty())
        notes.push_back(fmt::format("materials lose {}", names));
    if (any_of(root, "images", [](const Json& image) {
            const std::string type = text_member(image, "mimeType"), uri = text_member(image, "uri");
            return type.empty() ? !uri.ends_with(".png") && !uri.starts_with("data:image/png") : type != "image/png";
        }))
        notes.emplace_back("images are written as PNG");
    const bool extras = std::ranges::any_of(std::array{"nodes", "meshes", "materials", "cameras", "images", "textures"},
                                            [&](const char* list) { return any_of(root, list, has_foreign_extras); });
    if (extras) notes.emplace_back("extras of nodes, meshes, materials, cameras and images are dropped");
    if (const Json* const asset = member(&root, "asset"); asset && asset->is_object() && asset->contains("copyright"))
        notes.push_back(fmt::format("the copyright is dropped: {}", printable(text_member(*asset, "copyright"), 120)));
    return notes;
}

}  // namespace si::gltf
