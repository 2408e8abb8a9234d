#include "renderer/gltf/extras.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/base/printable.h"
#include "renderer/settings/param.h"

namespace si::gltf {
namespace {

constexpr std::size_t kMostSuggestions = 100000;  // three for each of 30,000 objects

/// Returns this program's part of an object's extras, or null.
const Json* own_extras(const Json& object) {
    const Json* const own = member(member(&object, "extras"), kExtrasKey);
    return own && own->is_object() ? own : nullptr;
}

/// Notes a file that an importer needed beside the model. A name that leaves the folder is passed over.
void note_file_below(Context& context, const std::string& name) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path model = fs::canonical(context.path(), error);
    const fs::path path = fs::path(name).lexically_normal();
    if (error || path.empty() || path.is_absolute() || *path.begin() == ".." || name.find('\0') != name.npos) return;
    const fs::path whole = model.parent_path() / path;
    if (whole != model) context.note_file(whole);
}

}  // namespace

void read_scene_extras(Context& context, const Json& root, int scene_index, Scene& scene) {
    const auto scenes = root.find("scenes");
    if (scenes == root.end() || !scenes->is_array()) return;
    if (scene_index < 0) {
        const auto chosen = root.find("scene");
        scene_index = chosen != root.end() && chosen->is_number_unsigned() ? chosen->get<int>() : 0;
    }
    if (std::size_t(scene_index) >= scenes->size()) return;
    const Json* own = own_extras((*scenes)[std::size_t(scene_index)]);
    if (!own) return;
    if (own->contains("about") && (*own)["about"].is_string()) scene.about = printable(text_member(*own, "about"), 500);
    const Json* const suggested = member(own, "suggested");
    if (!suggested) return;
    if (!suggested->is_object() || suggested->size() > kMostSuggestions) {
        context.warn("its suggested settings are no object of at most 100000 members; they are left out");
        return;
    }
    for (const auto& [key, value] : suggested->items()) {
        try {
            if (!value.is_string()) throw UsageError(fmt::format("{}: the value is no text", key));
            Settings unused;
            if (const auto ref = find_setting(key); ref && ref->param->file)
                throw UsageError(fmt::format("{}: a model names no file of a setting", key));
            set_setting(unused, key, value.get_ref<const std::string&>());
            scene.suggested.emplace_back(key, value.get<std::string>());
        } catch (const UsageError& e) {
            context.warn(fmt::format("a suggested setting is left out: {}", printable(e.what(), 300)));
        }
    }
}

void read_importer_extras(Context& context, const Json& root, Scene& scene) {
    const Json* const own = own_extras(root["asset"]);
    if (!own) return;
    if (const Json* const notes = member(own, "notes"); notes && notes->is_array())
        for (const Json& note : *notes)
            if (note.is_string()) context.warn(note.get_ref<const std::string&>());
    Settings said;
    try {
        if (own->contains("up")) set_setting(said, "scene.up", text_member(*own, "up"));
    } catch (const UsageError& e) {
        context.warn(e.what());
    }
    if (said.scene.up != UpAxis::File) scene.file_up = said.scene.up;
    const Json* const unit = member(own, "unit");
    if (unit && is_number_within(*unit, 1e-9, 1e9)) scene.file_unit_m = unit->get<double>();
    if (const Json* const files = member(own, "files"); files && files->is_array())
        for (const Json& file : *files)
            if (file.is_string()) note_file_below(context, file.get_ref<const std::string&>());
}

bool is_automatic_camera_field(const Json& camera, const char* name) {
    const Json* own = own_extras(camera);
    return own && own->value(name, Json()) == Json(true);
}

}  // namespace si::gltf
