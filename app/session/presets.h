// Presets: settings that differ from the program's defaults, as JSON that people can read and merge.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/claims.h"
#include "renderer/settings/settings.h"

namespace si {

/// Preset: settings with the scene that they were made for, a title and a description.
struct Preset {
    std::string title;  ///< a few words; may be empty, like all texts here
    std::string topic;  ///< heading in lists, such as "Bias"
    std::string about;  ///< description: a sentence on what to look at
    std::string scene;  ///< scene that the preset was made for: built-in key or path
    Settings settings;
    std::vector<PresetClaim> claims = {};  ///< statements of the description, as comparisons of metrics
};

/// Parses a preset completely or not at all. @throws Error "NAME: place: what is wrong and what is allowed"
Preset parse_preset(std::string_view json, const std::string& name);
/// Formats a preset as JSON that parse_preset() reads. Equal settings give equal bytes.
std::string preset_text(const Preset& preset);

/// Loads a built-in preset by key, or a preset file. @throws Error
Preset load_preset(const std::string& name_or_path);
/// Writes a preset file atomically. @throws Error, also for a name or text that is not UTF-8
void save_preset(const Preset& preset, const std::filesystem::path& path);

/// Key and texts of a preset that is embedded in the program.
struct BuiltinPreset {
    std::string key;  ///< file name without extension and leading number ("010-acne.json": acne)
    std::string title, topic, about, scene;
};
/// Lists the guided presets embedded in the program, in the order of a lecture.
std::vector<BuiltinPreset> builtin_presets();
/// Lists the hard cases as presets, each once with its fault and once with its fix (renderer/scenes/hard_cases.h).
/// load_preset() accepts their keys too.
std::vector<BuiltinPreset> hard_case_presets();

}  // namespace si
