// Axes of a sweep: settings with lists of values, their cross product, and the merging of equivalent cases.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// Axis of a sweep: one setting and its values as text.
struct SweepAxis {
    std::string key;
    std::vector<std::string> values;
    std::set<std::string> held = {};  ///< keys of settings to which the axis brings no starting values
};

/// Parses an axis of a sweep from the option --vary: "KEY=V1,V2,..." or "KEY=from:to:step", ends included. A step
/// "*factor" makes a geometric series. "KEY=*" lists all choices of a setting (Param::swept where the setting has it).
/// @throws UsageError naming key, value and the allowed form
SweepAxis parse_axis(std::string_view text);

/// Holds settings that the sweep's own --set name: an axis over bias.kind brings them no starting values.
void hold_assigned(std::vector<SweepAxis>& axes, const std::set<std::string>& assigned_keys);

/// Case of a sweep: one combination of the axes' values, and the settings that follow.
struct SweepCase {
    std::vector<std::pair<std::string, std::string>> values;  ///< setting key and value per axis, in the axes' order
    std::vector<std::pair<std::string, std::string>>
        starts;  ///< starting values that the case's bias.kind brings along
    Settings settings;
    std::string id;  ///< "key=value key=value": unique within a sweep
    /// Returns all that the case sets: `values`, then `starts`.
    std::vector<std::pair<std::string, std::string>> sets() const;
};

/// Cases of a sweep, after equivalent ones were merged.
struct SweepPlan {
    std::vector<SweepCase> cases;
    std::size_t product = 0;         ///< number of cases before merging
    std::vector<std::string> notes;  ///< one line for each axis with values that make no difference
};

/// Largest number of cases that a sweep may have.
inline constexpr std::size_t kMaxSweepCases = 100'000;

/// Computes the cross product of axes over base settings. Cases that differ only in settings without effect are merged
/// into the first of them. With an axis of scene.* only equal settings are merged, since settings that a scene suggests
/// depend on the scene. An axis over bias.kind brings the starting values of another kind than the base's along, except
/// to settings that an axis varies or SweepAxis::held names.
/// @throws UsageError when a key is varied twice, directly or through a value that implies it, or when there are more
/// than kMaxSweepCases
SweepPlan plan_sweep(const Settings& base, const std::vector<SweepAxis>& axes);

/// Returns settings in which every setting without effect has its default value. Settings that differ only in settings
/// without effect, and so draw the same picture, become equal.
Settings without_ineffective_settings(Settings settings);

/// Returns settings without display aids (view.*: overlays, panes, map viewer), which cost time but are no part of the
/// shadow. Keeps view.light. Measurements use these settings.
Settings measured_settings(Settings settings);

}  // namespace si
