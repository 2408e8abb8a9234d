#include "app/session/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/base/json_text.h"
#include "app/base/output.h"
#include "app/session/setting_json.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/embedded.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/base/printable.h"
#include "renderer/bundle/builtin_bundles.h"
#include "renderer/scenes/hard_cases.h"
#include "renderer/settings/earlier.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

constexpr std::string_view kFormat = "shadow-inspector-preset";
constexpr std::string_view kFolder = "assets/presets/", kExtension = ".json";

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
    throw Error(fmt::format("{}: {}", name, why));
}

std::string text_member(const Json& json, const char* key, const std::string& name) {
    const auto it = json.find(key);
    if (it == json.end()) return {};
    if (!it->is_string()) refuse(name, fmt::format("\"{}\" must be a text", key));
    return it->get<std::string>();
}

/// Reads the version of a preset file. @throws Error
int check_header(const Json& json, const std::string& name) {
    static const std::vector<std::string> known = {"format", "version", "title",    "topic",
                                                   "about",  "scene",   "settings", "claims"};
    if (!json.is_object()) refuse(name, "not a preset: must be an object {\"format\": ...}");
    const auto format = json.find("format");
    if (format == json.end() || *format != kFormat)
        refuse(name, fmt::format("not a preset: \"format\" must be \"{}\"", kFormat));
    const auto version = json.find("version");
    const bool whole = version != json.end() && version->is_number_integer();
    if (!whole || *version < oldest_settings_version() || *version > kSettingsVersion)
        refuse(name,
               fmt::format("\"version\" is {}, but this program reads {}{}",
                           version == json.end() ? "missing" : quoted(*version), readable_versions(),
                           whole && *version > kSettingsVersion ? ": a newer one wrote the file; open it there" : ""));
    for (const auto& [key, value] : json.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            const std::string nearest = nearest_name(key, known);
            refuse(name, fmt::format("\"{}\": unknown member{}", printable(key, 60),
                                     did_you_mean(nearest.empty() ? "" : "\"" + nearest + "\"")));
        }
    }
    const auto settings = json.find("settings");
    if (settings == json.end() || !settings->is_object()) refuse(name, "\"settings\" must be an object of key: value");
    return version->get<int>();
}

/// Returns the presets embedded in the program, by file name.
std::vector<const EmbeddedFile*> preset_files() {
    std::vector<const EmbeddedFile*> files;
    for (const EmbeddedFile& file : embedded_files())
        if (file.path.starts_with(kFolder) && file.path.ends_with(kExtension)) files.push_back(&file);
    std::sort(files.begin(), files.end(), [](const auto* a, const auto* b) { return a->path < b->path; });
    return files;
}

/// Returns the file's name without the number that orders it.
std::string preset_key(const EmbeddedFile& file) {
    const std::string stem = std::filesystem::path(file.path).stem().string();
    const auto digits = stem.find_first_not_of("0123456789");
    return digits != 0 && digits != std::string::npos && stem[digits] == '-' ? stem.substr(digits + 1) : stem;
}

Preset preset_of(const HardCaseView& view) {
    return {.title = fmt::format("{}. {}{}", view.row->number, view.row->title,
                                 view.fixed && !view.row->broken.empty() ? ", mended" : ""),
            .topic = "Hard cases",
            .about = view.about(),
            .scene = view.name(),
            .settings = view.settings()};
}

}  // namespace

Preset parse_preset(std::string_view text, const std::string& name) {
    const Json json = parse_json_text(text, name);
    const int version = check_header(json, name);
    Preset preset;
    preset.title = text_member(json, "title", name);
    preset.topic = text_member(json, "topic", name);
    preset.about = text_member(json, "about", name);
    preset.scene = text_member(json, "scene", name);
    if (json.contains("scene") && preset.scene.empty()) refuse(name, "scene: is empty; name one, or leave it out");
    std::map<std::string, std::string> written;  // canonical key -> key as written
    std::vector<SettingValue> values;
    for (const auto& [key, value] : json["settings"].items()) {
        const std::string place = fmt::format("settings.\"{}\": ", printable(key));
        const auto ref = find_setting(key);
        if (!ref) refuse(name, place + "unknown setting" + did_you_mean(nearest_key(key)));
        try {
            const std::size_t first = values.size();
            values.emplace_back(*ref, setting_from_json(*ref, value));
            if (value.is_string())
                std::ranges::move(implied_values(*ref, value.get<std::string>()), std::back_inserter(values));
            for (std::size_t i = first; i < values.size(); ++i) {
                const auto [earlier, is_new] = written.emplace(setting_key(values[i].first), key);
                if (!is_new)
                    refuse(name,
                           place + fmt::format("the same setting as \"{}\"; keep one", printable(earlier->second)));
            }
        } catch (const UsageError& e) {
            refuse(name, place + e.what());
        }
    }
    try {
        if (json.contains("claims")) preset.claims = read_claims(json["claims"]);
    } catch (const Error& e) {
        refuse(name, e.what());
    }
    preset.settings = defaults_of_version(version, configured_light_count(values));
    for (const auto& [ref, value] : values) set_value(preset.settings, ref, value);
    return preset;
}

std::string preset_text(const Preset& preset) {
    Json json;
    json["format"] = kFormat;
    json["version"] = kSettingsVersion;
    for (const auto& [key, text] : {std::pair{"title", &preset.title},
                                    {"topic", &preset.topic},
                                    {"about", &preset.about},
                                    {"scene", &preset.scene}})
        if (!text->empty()) json[key] = *text;
    json["settings"] = Json::object();
    for (const SettingRef& ref : changed_settings(preset.settings))
        json["settings"][setting_key(ref)] = setting_to_json(ref, get_value(preset.settings, ref));
    std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
    if (preset.claims.empty()) return text + "\n";
    text.resize(text.size() - std::string_view("\n}").size());
    std::string lines;  // a claim is one line
    for (const PresetClaim& claim : preset.claims) lines += (lines.empty() ? "\n    " : ",\n    ") + claim.text;
    return text + ",\n  \"claims\": [" + lines + "\n  ]\n}\n";
}

namespace {

/// Replaces each path of a preset's settings that is set by what `work` makes of it.
template <typename Work>
void for_each_path(Settings& settings, const Work& work) {
    for (const SettingRef& ref : changed_settings(settings)) {
        if (!ref.param->file) continue;
        const std::filesystem::path path = std::get<std::string>(get_value(settings, ref));
        if (path.empty() || is_builtin_bundle(path)) continue;
        set_value(settings, ref, work(path).string());
    }
}

/// Returns the folder of a file.
std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Makes the paths of a preset's settings, which are relative to its folder, relative to the working directory.
void paths_from_folder(Settings& settings, const std::filesystem::path& file) {
    for_each_path(settings, [&](const std::filesystem::path& path) {
        return path.is_absolute() ? path : (folder_of(file) / path).lexically_normal();
    });
}

/// Makes the paths of a preset's settings relative to its folder.
void paths_to_folder(Settings& settings, const std::filesystem::path& file) {
    for_each_path(settings, [&](const std::filesystem::path& path) {
        std::error_code error;
        // Links of the folder are resolved, so that ".." leads where it should.
        const std::filesystem::path folder = std::filesystem::weakly_canonical(folder_of(file), error);
        if (error) return path;
        // weakly_canonical() leaves a path relative if its first part does not exist.
        const std::filesystem::path given = std::filesystem::absolute(path, error);
        if (error) return path;
        const std::filesystem::path whole = std::filesystem::weakly_canonical(given, error);
        if (error) return path;
        const std::filesystem::path relative = whole.lexically_relative(folder);
        return relative.empty() ? whole : relative;
    });
}

}  // namespace

Preset load_preset(const std::string& name_or_path) {
    std::vector<std::string> keys;
    for (const EmbeddedFile* file : preset_files()) {
        keys.push_back(preset_key(*file));
        if (keys.back() == name_or_path) return parse_preset(file->text, name_or_path);
    }
    if (const auto view = find_hard_case(name_or_path)) return preset_of(*view);
    if (name_or_path.starts_with(kHardPrefix))
        for (const HardCaseView& view : hard_case_views()) keys.push_back(view.name());
    std::error_code error;
    if (!std::filesystem::exists(name_or_path, error) && lower_extension(name_or_path) != kExtension && !keys.empty())
        throw UsageError(fmt::format("no preset '{}': there is no built-in one of that name, and files end in .json{}",
                                     name_or_path, did_you_mean(nearest_name(name_or_path, keys))));
    Preset preset = parse_preset(read_text_file(name_or_path), name_or_path);
    paths_from_folder(preset.settings, name_or_path);
    return preset;
}

void save_preset(const Preset& preset, const std::filesystem::path& path) {
    // JSON would replace the bytes, and the preset would then name nothing.
    const auto require_utf8 = [&](std::string_view what, const std::string& text) {
        if (!is_utf8(text))
            refuse(path.string(),
                   fmt::format("{} \"{}\" is not UTF-8, which a preset must be; rename it", what, printable(text)));
    };
    require_utf8("the name", path.filename().string());
    require_utf8("the scene", preset.scene);
    require_utf8("the title", preset.title);
    require_utf8("the topic", preset.topic);
    require_utf8("the sentence", preset.about);
    for (const auto& [object, own] : preset.settings.objects) require_utf8("the object", object);
    Preset written = preset;
    paths_to_folder(written.settings, path);
    write_regular_file(path, preset_text(written));
}

std::vector<BuiltinPreset> builtin_presets() {
    std::vector<BuiltinPreset> list;
    for (const EmbeddedFile* file : preset_files()) {
        Preset preset = parse_preset(file->text, std::string(file->path));
        list.push_back({preset_key(*file), preset.title, preset.topic, preset.about, preset.scene});
    }
    return list;
}

std::vector<BuiltinPreset> hard_case_presets() {
    std::vector<BuiltinPreset> list;
    for (const HardCaseView& view : hard_case_views()) {
        const Preset preset = preset_of(view);
        list.push_back({view.name(), preset.title, preset.topic, preset.about, preset.scene});
    }
    return list;
}

}  // namespace si
