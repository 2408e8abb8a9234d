// What differs between two presets, in words.
#pragma once

#include <string>
#include <vector>

#include "app/session/presets.h"
#include "renderer/settings/param.h"

namespace si {

struct PresetDifference {
    std::string group;  ///< heading: "Bias", "Light 2", "Object Root/Box", "Scene"
    std::string key;    ///< "bias.constant"; "scene" for the scene that the presets are made for
    std::string text;   ///< "bias.constant: 0.1 → 0 texels (Constant)"
    std::string note;   ///< why it does not matter in either; empty when it does
};

/// From `a` to `b`, the scene first, then settings in table order. Titles and sentences do not count.
std::vector<PresetDifference> preset_differences(const Preset& a, const Preset& b);

/// The differences under their headings, one line each; a line that says so when there are none.
std::string differences_text(const std::vector<PresetDifference>& differences, const std::string& name_a,
                             const std::string& name_b);

/// A preset file, a built-in preset, or "default": the program's defaults without a scene. @throws Error
Preset load_preset_or_default(const std::string& name_or_path);

}  // namespace si
