// Presets: the settings that differ from the program's defaults, as JSON that people can read and merge.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/claims.h"
#include "renderer/settings/settings.h"

namespace si {

struct Preset {
    std::string title;  ///< a few words; may be empty, as all texts
    std::string topic;  ///< what it is listed under, such as "Bias"
    std::string about;  ///< what to look at, a sentence
    std::string scene;  ///< built-in key or path the preset was made for
    Settings settings;
    std::vector<PresetClaim> claims = {};  ///< what the sentence says, as numbers
};

/// Reads a preset: all of it or nothing. @throws Error "NAME: place: what is wrong and what is allowed".
Preset parse_preset(std::string_view json, const std::string& name);
/// The preset as parse_preset() reads it; equal settings give equal bytes.
std::string preset_text(const Preset& preset);

/// A built-in preset by key, or a file. @throws Error
Preset load_preset(const std::string& name_or_path);
/// Writes atomically. @throws Error
void save_preset(const Preset& preset, const std::filesystem::path& path);

struct BuiltinPreset {
    std::string
        key;  ///< the file's name without extension and without the number that orders it ("010-acne.json": acne)
    std::string title, topic, about, scene;
};
/// The presets that travel inside the program, in the order in which a lecture walks through them.
std::vector<BuiltinPreset> builtin_presets();
/// The hard cases, each with its fault and with its remedy (renderer/scenes/hard_cases.h); load_preset() takes their
/// keys, too.
std::vector<BuiltinPreset> hard_case_presets();

}  // namespace si
