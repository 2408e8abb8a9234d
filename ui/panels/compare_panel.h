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
/// Choice of the settings that the panel Compare compares with.
struct CompareWith {
    CompareKind kind = CompareKind::Scene;
    std::string preset;  ///< key of a built-in preset or path, if kind is Preset
    bool operator==(const CompareWith&) const = default;
};

/// Settings pinned as A, which later settings are compared with.
struct PinnedSettings {
    Settings settings;
    std::string scene;  ///< scene that the settings were pinned with: built-in key or path
    bool operator==(const PinnedSettings&) const = default;
};

/// Settings that PictureState::compare names, once they are loaded.
struct ComparisonFacts {
    CompareWith with;
    Settings settings;
    std::string scene;    ///< scene that they were made for; empty: any
    std::string problem;  ///< why there are no settings
};

/// Returns the name of the settings to compare with: "the scene's own settings", or a preset's key or path.
std::string reference_label(const CompareWith& with);
/// Returns the label for the panel: a built-in preset's title, a file's name without folders, else reference_label().
std::string shown_label(const CompareWith& with, std::span<const PresetEntry> presets);

/// Draws the panel Compare: the settings that differ from those of `other`.
/// @param compare choice of the settings to compare with; the combo changes it
/// @param settings present settings; a button replaces them by the compared ones
/// @param pinned the pinned settings; nothing: they are no choice
/// @param scene_name the name of the shown scene
/// @param other the settings that `compare` names. If it is null, or belongs to an earlier choice, they are not loaded
/// yet
void draw_compare(CompareWith& compare, Settings& settings, const std::optional<PinnedSettings>& pinned,
                  const std::string& scene_name, const ComparisonFacts* other, const PresetsFacts& presets,
                  PresetRequests& requests);

}  // namespace si
