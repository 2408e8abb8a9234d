// What the present state is compared with.
#pragma once

#include <string>

#include "renderer/settings/settings.h"

namespace si {

/// What the present state is compared with; Pinned: what PictureState::pinned holds.
enum class CompareKind { Scene, Defaults, Preset, Pinned };
struct CompareWith {
    CompareKind kind = CompareKind::Scene;
    std::string preset;  ///< built-in key or path
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
    std::string scene;    ///< that it was made for; empty: any
    std::string problem;  ///< why there are no settings
};

/// "the scene's own settings", or the preset as it is named: its key or path.
std::string reference_label(const CompareWith& with);

}  // namespace si
