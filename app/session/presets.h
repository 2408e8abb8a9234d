// Presets: settings that differ from the program's defaults, as JSON that people can read and merge.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/claims.h"
#include "renderer/settings/settings.h"

namespace si {

/// Preset: settings with the scene for which they were made, a title and a description.
struct Preset {
    std::string title;  ///< a few words; may be empty, like all texts here
    std::string topic;  ///< heading in lists, such as "Bias"
    std::string about;  ///< description: a sentence on what to look at
    std::string scene;  ///< scene that the preset was made for: built-in key or path
    Settings settings;
    std::vector<PresetClaim> claims = {};  ///< statements of the description, as comparisons of metrics
};

/// Parses the JSON text of a preset, completely or not at all. @param name name of the file, for messages @throws Error
/// "NAME: place: what is wrong and what is allowed"
Preset parse_preset(std::string_view json, const std::string& name);
/// Formats a preset as JSON that parse_preset() reads. Equal settings give equal bytes.
std::string preset_text(const Preset& preset);

/// Loads a preset: a built-in one by key, or a file. @throws Error; UsageError for an unknown key
Preset load_preset(const std::string& name_or_path);
/// Writes a preset to a file, replacing it atomically. @throws Error, also for a path or text that is not UTF-8
void save_preset(const Preset& preset, const std::filesystem::path& path);

/// Entry of the list of presets that are embedded in the program: key and texts.
struct BuiltinPreset {
    std::string key;  ///< file name without extension and leading number ("010-acne.json": acne)
    std::string title, topic, about, scene;
};
/// Lists the guided presets embedded in the program. Each has a sentence on what to look at; their order is that of a
/// lecture.
std::vector<BuiltinPreset> builtin_presets();
/// Lists presets for the hard cases (situations in which shadow maps break, renderer/scenes/hard_cases.h). Every case
/// has a preset with its fix. If some settings bring the fault back, the case has a second preset that shows the fault.
/// load_preset() accepts their keys.
std::vector<BuiltinPreset> hard_case_presets();

}  // namespace si
