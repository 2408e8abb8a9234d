// Table of cascade splits: ways to divide the camera's depth among cascades, and the order of manual splits.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/settings/param.h"

namespace si {

/// Row of the table of cascade splits: one way to divide the camera's depth among cascades (light.split).
struct SplitRow {
    std::string_view key, label, help;
    std::string_view paper;                           ///< source; empty: common knowledge
    std::span<const std::string_view> settings = {};  ///< setting keys that only rows listing them read
};

/// Returns the table of cascade splits, in the order of the enumeration Split.
std::span<const SplitRow> splits();

/// Returns the manual far ends of all cascades but the last (light.split_1 to light.split_7), as shares of the divided
/// depth.
std::array<double, kMaxCascades - 1> manual_splits(const LightSettings& light);

/// Keeps manual splits in order after an edit of the split `changed`. Earlier splits above its value are lowered to it,
/// and later splits below its value are raised to it. Does nothing if `changed` is no manual split.
void push_splits(Settings& settings, const SettingRef& changed);

/// Raises each manual split that is below the split before it to that one, for lights with manual cascades. Appends one
/// line per repair.
void repair_splits(Settings& settings, std::vector<std::string>& repairs);

}  // namespace si
