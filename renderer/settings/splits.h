// The table of ways to divide the camera's depth among cascades, and what keeps splits by hand in order.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/settings/param.h"

namespace si {

struct SplitRow {
    std::string_view key, label, help;
    std::string_view paper;                           ///< where it is from; empty: it is common
    std::span<const std::string_view> settings = {};  ///< keys that only it and other rows that list them read
};

/// In the order of Split, whose names the program itself knows.
std::span<const SplitRow> splits();
std::span<const Choice> split_choices();

/// Where the cascades but the last end by hand: light.split_1 to light.split_7.
std::array<double, kMaxCascades - 1> manual_splits(const LightSettings& light);

/// Where `changed` is a split by hand: moves those before it down to it and those after it up to it, so that none lies
/// before the one before it.
void push_splits(Settings& settings, const SettingRef& changed);

/// Moves each split by hand that lies before the one before it up to that, of lights whose cascades they divide.
/// Appends a line per repair.
void repair_splits(Settings& settings, std::vector<std::string>& repairs);

}  // namespace si
