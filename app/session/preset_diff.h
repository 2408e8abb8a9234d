// Differences between two presets, in words.
#pragma once

#include <string>
#include <vector>

#include "app/session/presets.h"
#include "renderer/settings/param.h"

namespace si {

/// Setting in which two presets differ, with both values as text.
struct PresetDifference {
    std::string group;  ///< heading: "Bias", "Light 2", "Object Root/Box", "Scene"
    std::string key;    ///< "bias.constant"; "scene" for the scene that the presets are made for
    std::string text;   ///< "bias.constant: 0.1 → 0 texels (Constant)"
    std::string note;   ///< reason why the setting has no effect in either preset; empty: it has an effect
};

/// Lists the settings in which preset b differs from preset a. The scene comes first, then settings in the order of
/// their table. Titles and descriptions are not compared.
std::vector<PresetDifference> preset_differences(const Preset& a, const Preset& b);

/// Formats the differences of two presets as text: their number, then one line each below the headings of their groups.
/// Without differences the text is "A and B are equal". @param name_a, name_b names of the presets
std::string differences_text(const std::vector<PresetDifference>& differences, const std::string& name_a,
                             const std::string& name_b);

/// Loads a preset file, a built-in preset, or "default": the program's default settings without a scene. @throws Error
Preset load_preset_or_default(const std::string& name_or_path);

}  // namespace si
