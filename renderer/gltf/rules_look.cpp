// Validation of materials, textures and samplers. Wrong values and references are dropped with a warning, as they
// change the look alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "renderer/gltf/rules.h"

namespace si::gltf {
namespace {

void erase_unless(Context& context, Json& object, const Place& place, const char* key,
                  const std::function<bool(const Json&)>& good) {
    const auto it = object.find(key);
    if (it == object.end() || good(*it)) return;
    context.warn(Place(place, key), "has no valid value; the default is used");
    object.erase(it);
}

/// Erases a reference to an element that does not exist, with a warning that ends in `consequence`.
/// @param what the element: "image"
void erase_missing(Context& context, Json& object, const Place& place, const char* key, std::string_view what,
                   std::size_t size, std::string_view consequence) {
    const auto it = object.find(key);
    if (it == object.end() || index_member(object, key, size)) return;
    const std::string fault = it->is_number_unsigned()
                                  ? fmt::format("{} {} does not exist, the file has {}", what, it->dump(), size)
                                  : fmt::format("names no {}", what);
    context.warn(Place(place, key), fmt::format("{}; {}", fault, consequence));
    object.erase(it);
}

bool is_object(const Json& value) {
    return value.is_object();
}

void check_texture_info(Context& context, Json& owner, const Place& owner_place, const char* key, const Sizes& sizes) {
    erase_unless(context, owner, owner_place, key, is_object);
    const auto it = owner.find(key);
    if (it == owner.end()) return;
    const Place place(owner_place, key);
    erase_missing(context, *it, place, "index", "texture", sizes.textures, "drawn untextured");
    if (!it->contains("index")) {
        owner.erase(it);
        return;
    }
    erase_unless(context, *it, place, "texCoord",
                 [](const Json& v) { return v.is_number_unsigned() && v.get<std::uint64_t>() < 64; });
    erase_unless(context, *it, place, "scale", [](const Json& v) { return is_number_within(v, -1e6, 1e6); });
    erase_unless(context, *it, place, "extensions", is_object);
}

void check_material(Context& context, Json& material, const Place& place, const Sizes& sizes) {
    erase_unless(context, material, place, "extensions", is_object);
    erase_unless(context, material, place, "doubleSided", [](const Json& v) { return v.is_boolean(); });
    erase_unless(context, material, place, "alphaMode",
                 [](const Json& v) { return v == "OPAQUE" || v == "MASK" || v == "BLEND"; });
    erase_unless(context, material, place, "alphaCutoff", [](const Json& v) { return is_number_within(v, 0, 1e6); });
    check_texture_info(context, material, place, "normalTexture", sizes);
    for (const char* unused : {"occlusionTexture", "emissiveTexture"}) material.erase(unused);
    erase_unless(context, material, place, "pbrMetallicRoughness", is_object);
    const auto pbr = material.find("pbrMetallicRoughness");
    if (pbr == material.end()) return;
    const Place pbr_place(place, "pbrMetallicRoughness");
    erase_unless(context, *pbr, pbr_place, "baseColorFactor", [](const Json& v) {
        return v.is_array() && v.size() == 4 &&
               std::all_of(v.begin(), v.end(), [](const Json& c) { return is_number_within(c, 0, 1e6); });
    });
    check_texture_info(context, *pbr, pbr_place, "baseColorTexture", sizes);
    for (const char* unused : {"metallicRoughnessTexture", "metallicFactor", "roughnessFactor"}) pbr->erase(unused);
}

bool is_one_of(const Json& value, std::initializer_list<int> allowed) {
    return std::any_of(allowed.begin(), allowed.end(), [&](int a) { return value == a; });
}

}  // namespace

void check_look(Context& context, Json& root, const Sizes& sizes) {
    for (std::size_t i = 0; i < sizes.materials; ++i) {
        root["materials"][i].erase("emissiveFactor");  // not drawn
        check_material(context, root["materials"][i], Place("materials", i), sizes);
    }
    for (std::size_t i = 0; i < sizes.textures; ++i) {
        const Place place("textures", i);
        Json& texture = root["textures"][i];
        erase_missing(context, texture, place, "sampler", "sampler", sizes.samplers, "the default is used");
        erase_missing(context, texture, place, "source", "image", sizes.images, "what reads it is drawn untextured");
    }
    for (std::size_t i = 0; i < sizes.samplers; ++i) {
        const Place place("samplers", i);
        Json& sampler = root["samplers"][i];
        for (const char* wrap : {"wrapS", "wrapT"}) {
            erase_unless(context, sampler, place, wrap, [](const Json& v) {
                return is_one_of(v, {10497, 33071, 33648});
            });
        }
        erase_unless(context, sampler, place, "magFilter", [](const Json& v) { return is_one_of(v, {9728, 9729}); });
        erase_unless(context, sampler, place, "minFilter", [](const Json& v) {
            return is_one_of(v, {9728, 9729, 9984, 9985, 9986, 9987});
        });
    }
}

}  // namespace si::gltf
