// The panel Compare, and the settings that it compares the present ones with.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "renderer/settings/settings.h"

namespace si {

struct PresetEntry;
struct PresetRequests;
struct PresetsFacts;

/// Source of the settings that the panel Compare compares with. Pinned: PictureState::pinned. Tried:
/// PictureState::tried.
enum class CompareKind { Scene, Defaults, Preset, Pinned, Tried };
/// Choice in the panel Compare: which settings it compares with the present ones. Holds no values of settings.
struct CompareWith {
    CompareKind kind = CompareKind::Scene;
    std::string preset;  ///< key of a built-in preset or path, if kind is Preset
    bool operator==(const CompareWith&) const = default;
};

/// Settings that the user has pinned as A, so that later settings can be compared with them.
struct PinnedSettings {
    Settings settings;
    std::string scene;  ///< scene that the settings were pinned with: built-in key or path
    bool operator==(const PinnedSettings&) const = default;
};

/// Settings with which the present ones are compared (PictureState::compare), after the application has loaded them, or
/// the reason why it could not.
struct ComparisonFacts {
    CompareWith with;
    Settings settings;
    std::string scene;    ///< scene that they were made for; empty: any
    std::string problem;  ///< why there are no settings
};

/// Returns the name of the settings that the present ones are compared with: "the scene's own settings", or a preset's
/// key or path.
std::string compared_settings_name(const CompareWith& with);
/// Returns the name of the settings that the present ones are compared with, as the panel Compare shows it. It is a
/// built-in preset's title, a file's name without folders, else compared_settings_name().
std::string shown_label(const CompareWith& with, std::span<const PresetEntry> presets);

/// Draws the panel Compare: a table of the settings in which the present settings and those of `other` differ.
/// @param compare choice of the settings to compare with, which the combo changes
/// @param settings present settings; buttons replace one or all of them by the compared ones
/// @param pinned the pinned settings; none: the combo does not offer them
/// @param scene_name name of the shown scene
/// @param other the settings that `compare` names; null or those of an earlier choice: not loaded yet
void draw_compare(CompareWith& compare, Settings& settings, const std::optional<PinnedSettings>& pinned,
                  const std::string& scene_name, const ComparisonFacts* other, const PresetsFacts& presets,
                  PresetRequests& requests);

}  // namespace si
