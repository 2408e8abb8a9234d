// Table of hard cases: situations in which shadow maps break. Each row has the fault, the fix, a measure, and a small
// scene with settings that shows it. Tests, the editor's menu and the command line read it. tests/hard_cases compares
// its measurements with the rows' limits; docs/lab/stability.md lists the results.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Row of the table of hard cases: a situation in which shadow maps break, its fix, and how both are measured.
struct HardCase {
    int number = 0;            ///< from 1, stable: the tests of a row are called HardCase<number>
    std::string_view key;      ///< "grazing": scene and preset are "hard/grazing", with the fix "hard/grazing-fixed"
    std::string_view title;    ///< a few words
    std::string_view fault;    ///< artefact and its cause, a sentence
    std::string_view fix;      ///< change that removes the fault, a sentence
    std::string_view measure;  ///< quantity measured with the fix in force; less is better
    double limit = 0;          ///< largest allowed value of the measure
    std::string_view unit;
    std::string_view limit_reason;   ///< reason of the limit
    std::string_view fault_measure;  ///< quantity that shows the fault without the fix
    double min_fault = 0;            ///< least value of `fault_measure`; below it the case proves nothing
    Scene (*make)() = nullptr;
    std::string_view view;    ///< common settings with and without the fix: "KEY=VALUE KEY=VALUE"
    std::string_view broken;  ///< further settings without the fix, which show the fault; empty: no setting shows it
    std::string_view fixed;   ///< further settings with the fix
};

/// Returns the table of hard cases (situations in which shadow maps break), in order of their numbers, which have no
/// gaps.
std::span<const HardCase> hard_cases();

inline constexpr std::string_view kHardPrefix = "hard/", kFixedSuffix = "-fixed";

/// Hard case (a situation in which shadow maps break) with or without its fix, as it is opened by name
/// ("hard/grazing-fixed").
struct HardCaseView {
    const HardCase* row = nullptr;
    bool fixed = false;
    /// Returns the name that opens this hard case as a scene or as a preset: "hard/" and its key, with "-fixed" for the
    /// view with the fix.
    std::string name() const;
    /// Returns a description of this hard case for people: whether its fix is on, and the sentences of its row in the
    /// table of hard cases.
    std::string about() const;
    /// Returns the settings that show this hard case, with or without its fix. Other settings have their defaults;
    /// cameras are the scene's own.
    Settings settings() const;
    /// Makes the scene of this hard case (docs/hard-cases.md). Its suggested settings show the fault, or the fix.
    Scene scene() const;
};

/// Finds a hard case by the name that opens it, such as "hard/grazing-fixed"; nullopt when there is none.
std::optional<HardCaseView> find_hard_case(std::string_view name);

/// Returns the views of all hard cases (situations in which shadow maps break), in order of their numbers. First comes
/// a case's view without its fix, then the view with it. If no setting shows the fault, the first view is missing.
std::span<const HardCaseView> hard_case_views();

}  // namespace si
