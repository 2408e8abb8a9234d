// The hard cases: corners in which shadow maps break, each with what goes wrong, what mends it, how that is measured,
// and a small scene with settings that show it. One table for tests, the editor's menu and the command line; the
// numbers of tests/hard_cases are judged by its rows, docs/stability.md lists what came out.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

struct HardCase {
    int number = 0;            ///< 1 to 36, stable: the tests of a row are called HardCase<number>
    std::string_view key;      ///< "grazing": its scene and preset are "hard/grazing", mended "hard/grazing-fixed"
    std::string_view title;    ///< a few words
    std::string_view fault;    ///< what goes wrong, a sentence
    std::string_view fix;      ///< what mends it, a sentence
    std::string_view measure;  ///< what is measured with the remedy in force; less is better
    double limit = 0;          ///< the most that the measure may be
    std::string_view unit;
    std::string_view why;      ///< of the limit
    std::string_view without;  ///< what shows that the fault is there without the remedy, in words
    double shown = 0;          ///< the least that this must be, or the case says nothing
    Scene (*make)() = nullptr;
    std::string_view view;    ///< settings of both presets: "KEY=VALUE KEY=VALUE"
    std::string_view broken;  ///< and of the fault; empty: no setting brings it back
    std::string_view fixed;   ///< and of the remedy
};

/// In order of their numbers, which have no gaps.
std::span<const HardCase> hard_cases();

inline constexpr std::string_view kHardPrefix = "hard/", kFixedSuffix = "-fixed";

/// A row with or without its remedy, as it is opened by name.
struct HardCaseView {
    const HardCase* row = nullptr;
    bool fixed = false;
    std::string name() const;   ///< "hard/grazing", "hard/grazing-fixed"
    std::string about() const;  ///< what is shown, and the row's sentences
    /// The row's settings over the defaults. Cameras are the scene's own.
    Settings settings() const;
    /// Its scene, which suggests these settings.
    Scene scene() const;
};

/// By name; nothing where there is no such.
std::optional<HardCaseView> find_hard_case(std::string_view name);

/// All that can be opened, by numbers: of each row the fault, where a setting shows it, and the remedy.
std::span<const HardCaseView> hard_case_views();

}  // namespace si
