// Axes of a sweep: settings with lists of values, their cross product, and the merging of equivalent cases.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// Axis of a sweep (a series of measurements over combinations of settings): one setting and its values as text.
struct SweepAxis {
    std::string key;
    std::vector<std::string> values;
    /// Keys of settings that keep their values when the axis changes bias.kind, and so do not get its starting values.
    std::set<std::string> held = {};
};

/// Parses an axis of a sweep from the command-line option --vary. The form is "KEY=V1,V2,..." or "KEY=from:to:step",
/// with both ends included. A step "*factor" makes a geometric series. "KEY=*" stands for the values in Param::swept if
/// the setting has them, else for all its choices. A setting that is on or off has the values false and true.
/// @throws UsageError naming key, value and the allowed form
SweepAxis parse_axis(std::string_view text);

/// Protects settings that the option --set of a sweep assigns. An axis over bias.kind then does not replace their
/// values by the starting values of each kind (SweepAxis::held).
/// @param assigned_keys keys of the settings that --set names
void protect_assigned_settings(std::vector<SweepAxis>& axes, const std::set<std::string>& assigned_keys);

/// Case of a sweep: one combination of the axes' values, with the complete settings to measure.
struct SweepCase {
    std::vector<std::pair<std::string, std::string>> values;  ///< setting key and value per axis, in the axes' order
    std::vector<std::pair<std::string, std::string>>
        starts;  ///< starting values that the case's bias.kind brings along
    Settings settings;
    std::string id;  ///< "key=value key=value": unique within a sweep
    /// Returns keys and values of all settings that this case of a sweep changes: first the varied ones (`values`),
    /// then starting values of a new bias.kind (`starts`).
    std::vector<std::pair<std::string, std::string>> sets() const;
};

/// Cases of a sweep to measure. Equivalent combinations of values are merged into one case.
struct SweepPlan {
    std::vector<SweepCase> cases;
    std::size_t product = 0;         ///< number of cases before merging
    std::vector<std::string> notes;  ///< one line for each axis with values that make no difference
};

/// Largest number of cases that a sweep may have.
inline constexpr std::size_t kMaxSweepCases = 100'000;

/// Computes the cases of a sweep: the cross product of the axes, applied to base settings. Cases that differ only in
/// settings without effect are merged into the first of them. With an axis over scene.*, only cases with equal settings
/// are merged, since each scene suggests settings of its own. A case with another bias.kind than the base also gets the
/// starting values of that kind, except for settings that are varied by an axis or listed in SweepAxis::held.
/// @throws UsageError when two axes vary one setting, or a value of one axis implies a setting that another axis
/// varies; or when there are more than kMaxSweepCases
SweepPlan plan_sweep(const Settings& base, const std::vector<SweepAxis>& axes);

/// Returns a copy of the settings in which every setting without effect has its default value. Settings that draw the
/// same picture become equal, so that a sweep measures them once.
Settings without_ineffective_settings(Settings settings);

/// Returns a copy of the settings without display aids (view.*: overlays, panes, map viewer), which cost time but do
/// not change the shadow. Keeps view.light. Every measurement of error or time uses this copy.
Settings measured_settings(Settings settings);

}  // namespace si
