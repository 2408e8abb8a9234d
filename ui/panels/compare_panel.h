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

/// Source of the settings that are compared with the present ones. Scene: the scene's own settings. Pinned: settings
/// that the user pinned as A. Tried: settings that a search proposes.
enum class CompareKind { Scene, Defaults, Preset, Pinned, Tried };
/// Choice of the settings that are compared with the present ones, by source and name. ComparisonFacts has their
/// values.
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

/// Loaded settings that are compared with the present ones (PictureState::compare), or the reason why loading failed.
struct ComparisonFacts {
    CompareWith with;
    Settings settings;
    std::string scene;    ///< scene that they were made for; empty: any
    std::string problem;  ///< why there are no settings
};

/// Returns the name of the settings that the present ones are compared with, such as "the scene's own settings" or
/// "pinned A"; for a preset its key or path.
std::string compared_settings_name(const CompareWith& with);
/// Returns the name of the settings that the present ones are compared with, as the panel Compare shows it. It is a
/// built-in preset's title, a file's name without folders, else compared_settings_name().
std::string shown_label(const CompareWith& with, std::span<const PresetEntry> presets);

/// Draws the panel Compare: a table of the settings whose values differ between `settings` and `other`.
/// @param compare choice of the settings to compare with, which the combo changes
/// @param settings present settings; buttons replace one or all of them by the compared ones
/// @param pinned the pinned settings; none: the combo does not offer them
/// @param scene_name name of the shown scene
/// @param other loaded settings of the choice `compare`. While these are still being loaded, it is null or has the
/// settings of the previous choice
void draw_compare(CompareWith& compare, Settings& settings, const std::optional<PinnedSettings>& pinned,
                  const std::string& scene_name, const ComparisonFacts* other, const PresetsFacts& presets,
                  PresetRequests& requests);

}  // namespace si
