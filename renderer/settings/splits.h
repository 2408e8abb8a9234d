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
    std::span<const std::string_view> settings = {};  ///< keys of settings that a row reads only if it lists them
};

/// Returns the table of cascade splits, the ways to divide the camera's depth among cascades, in the order of the
/// enumeration Split.
std::span<const SplitRow> splits();

/// Returns the manual far ends of all cascades but the last (light.split_1 to light.split_7), as shares of the camera
/// depth that the cascades divide.
std::array<double, kMaxCascades - 1> manual_splits(const LightSettings& light);

/// Keeps the manual cascade splits of a light in order after an edit of one of them. Splits before it are lowered to
/// its value where they are above, and splits after it are raised where they are below.
/// @param changed the edited setting; nothing happens if it is no manual split
void push_splits(Settings& settings, const SettingRef& changed);

/// Puts the manual cascade splits of all lights in order: a split that is below the one before it is raised to the same
/// value. Lights without manual cascades stay as they are.
/// @param repairs receives one line of text per repair
void repair_splits(Settings& settings, std::vector<std::string>& repairs);

}  // namespace si
