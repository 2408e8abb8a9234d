// Differences between two presets, in words.
#pragma once

#include <string>
#include <vector>

#include "app/session/presets.h"
#include "renderer/settings/param.h"

namespace si {

/// One setting in which two presets differ.
struct PresetDifference {
    std::string group;  ///< heading: "Bias", "Light 2", "Object Root/Box", "Scene"
    std::string key;    ///< "bias.constant"; "scene" for the scene that the presets are made for
    std::string text;   ///< "bias.constant: 0.1 → 0 texels (Constant)"
    std::string note;   ///< reason why the setting has no effect in either preset; empty: it has an effect
};

/// Lists the differences from preset a to preset b: the scene first, then settings in table order. Titles and
/// descriptions are not compared.
std::vector<PresetDifference> preset_differences(const Preset& a, const Preset& b);

/// Formats differences under their group headings, one line each; "no differences" as a line if there are none.
std::string differences_text(const std::vector<PresetDifference>& differences, const std::string& name_a,
                             const std::string& name_b);

/// Loads a preset file, a built-in preset, or "default" (the program's defaults without a scene). @throws Error
Preset load_preset_or_default(const std::string& name_or_path);

}  // namespace si
