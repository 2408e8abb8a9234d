// The other side of the comparison of settings.
#pragma once

#include <string>

#include "renderer/settings/settings.h"

namespace si {

/// Kind of settings to compare with. Pinned: PictureState::pinned.
enum class CompareKind { Scene, Defaults, Preset, Pinned };
/// Choice of settings to compare with.
struct CompareWith {
    CompareKind kind = CompareKind::Scene;
    std::string preset;  ///< built-in key or path, if kind is Preset
    bool operator==(const CompareWith&) const = default;
};

/// Settings that were kept as A, to compare later ones with.
struct PinnedSettings {
    Settings settings;
    std::string scene;  ///< built-in key or path of the scene that they were shown with
    bool operator==(const PinnedSettings&) const = default;
};

/// Settings that PictureState::compare names.
struct ComparisonFacts {
    CompareWith with;
    Settings settings;
    std::string scene;    ///< scene that they were made for; empty: any
    std::string problem;  ///< why there are no settings
};

/// Returns the name of the other side: "the scene's own settings", or a preset's key or path.
std::string reference_label(const CompareWith& with);

}  // namespace si
