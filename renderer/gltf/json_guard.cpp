#include "renderer/gltf/json_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "renderer/base/json_shape.h"

namespace si::gltf {
namespace {

constexpr int kDeepest = 64;
constexpr std::size_t kMostValues = 8'000'000;

/// Parses a version: "2.0" gives {2, 0}; {-1, -1} when it is none.
std::array<int, 2> version_numbers(const std::string& text) {
    std::array<int, 2> out{-1, -1};
    const char* end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, out[0]);
    if (major.ec != std::errc() || major.ptr == end || *major.ptr != '.') return {-1, -1};
    const auto minor = std::from_chars(major.ptr + 1, end, out[1]);
    if (minor.ec != std::errc() || minor.ptr != end) return {-1, -1};
    return out;
}

bool is_read_here(const std::string& extension) {
    static constexpr std::string_view kRead[] = {
        "KHR_lights_punctual",     "KHR_texture_transform",      "KHR_mesh_quantization",
        "KHR_materials_unlit",     "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",
        "KHR_meshopt_compression", "KHR_draco_mesh_compression", "EXT_texture_webp",
    };
    return std::find(std::begin(kRead), std::end(kRead), extension) != std::end(kRead);
}

/// Returns true for extensions that change only the look of surfaces, so that the geometry is right without them.
bool is_only_look(const std::string& extension) {
    static constexpr std::string_view kTexture[] = {"KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds",
                                                    "KHR_xmp_json_ld"};
    return extension.rfind("KHR_materials_", 0) == 0 ||
           std::find(std::begin(kTexture), std::end(kTexture), extension) != std::end(kTexture);
}

/// Removes extensions and extras from a JSON value and all values within.
void drop_extensions(Json& value) {
    if (!value.is_structured()) return;
    if (value.is_object())
        for (const char* key : {"extensions", "extras"}) value.erase(key);
    for (Json& part : value) drop_extensions(part);
}

}  // namespace

Json parse_json(Context& context, std::string_view text) {
    const JsonShape shape = json_shape(text);
    if (shape.depth > kDeepest) {
        context.fail(fmt::format("the JSON nests {} levels deep, at most {} are read", shape.depth, kDeepest),
                     "export the model without such extras");
    }
    if (shape.values > kMostValues) {
        context.fail(fmt::format("the JSON holds {} values, at most {} are read", shape.values, kMostValues),
                     "split the scene or merge its nodes");
    }
    try {
        Json root = Json::parse(text.begin(), text.end());
        if (!root.is_object()) context.fail("the JSON is not an object", "open a glTF 2.0 file");
        return root;
    } catch (const Json::exception& error) {
        std::string_view what = error.what();
        if (const auto bracket = what.find("] "); bracket != std::string_view::npos) what.remove_prefix(bracket + 2);
        context.fail(what, "repair the JSON or export the model again");
    }
}

void check_asset_and_extensions(Context& context, const Json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("version") || !(*asset)["version"].is_string()) {
        // glTF 1.0 files may lack an asset; their top-level collections are objects.
        context.fail(Place("asset"), "no version is given", "convert the model to glTF 2.0");
    }
    const auto& version = (*asset)["version"].get_ref<const std::string&>();
    if (version_numbers(version)[0] != 2) {
        context.fail(Place("asset.version"), fmt::format("version \"{}\" is not supported", version),
                     "convert the model to glTF 2.0");
    }
    if (const auto least = asset->find("minVersion"); least != asset->end()) {
        const auto numbers =
            least->is_string() ? version_numbers(least->get_ref<const std::string&>()) : std::array{-1, -1};
        if (numbers != std::array{2, 0}) {
            context.fail(Place("asset.minVersion"), "a reader newer than glTF 2.0 is asked for",
                         "convert the model to glTF 2.0");
        }
    }
    const auto required = root.find("extensionsRequired");
    if (required == root.end()) return;
    if (!required->is_array()) context.fail(Place("extensionsRequired"), "is not an array", "repair the file");
    for (const auto& entry : *required) {
        if (!entry.is_string())
            context.fail(Place("extensionsRequired"), "holds something that is no name", "repair the file");
        const auto& name = entry.get_ref<const std::string&>();
        if (is_read_here(name)) continue;
        if (name == "KHR_animation_pointer") {
            context.warn(Place("extensionsRequired"),
                         fmt::format("{} is not supported; the properties that it animates keep their values", name));
            continue;
        }
        if (!is_only_look(name)) {
            context.fail(Place("extensionsRequired"), fmt::format("{} is not supported", name),
                         "export the model without it");
        }
        context.warn(Place("extensionsRequired"),
                     fmt::format("{} is not supported; surfaces look plainer without it", name));
    }
}

const Json* member(const Json* object, const char* key) {
    if (!object || !object->is_object()) return nullptr;
    const auto it = object->find(key);
    return it == object->end() ? nullptr : &*it;
}

const Json* extension_of(const Json& object, const char* name) {
    return member(member(&object, "extensions"), name);
}

std::string text_member(const Json& object, const char* key) {
    const Json* const value = member(&object, key);
    return value && value->is_string() ? value->get<std::string>() : std::string();
}

std::optional<std::size_t> index_member(const Json& object, const char* key, std::size_t size) {
    const Json* const value = member(&object, key);
    if (!value || !value->is_number_unsigned() || value->get<std::uint64_t>() >= size) return std::nullopt;
    return value->get<std::size_t>();
}

bool is_number_within(const Json& value, double least, double most) {
    return value.is_number() && value.get<double>() >= least && value.get<double>() <= most;
}

std::string core_text(const Json& root) {
    Json core = Json::object();
    for (const auto& [key, value] : root.items())
        if (key != "buffers" && key != "images" && key != "cameras" && key != "animations") core[key] = value;
    drop_extensions(core);
    return core.dump();
}

}  // namespace si::gltf
