// What a sweep varies: axes of settings, their cross product, and which of its cases are the same thing.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/settings/settings.h"

namespace si {

/// One setting and the values it takes, as text.
struct SweepAxis {
    std::string key;
    std::vector<std::string> values;
};

/// Parses "KEY=V1,V2,..." or "KEY=from:to:step" (ends included; step may be "*factor" for a geometric row); for a
/// setting with choices "KEY=*" is every choice, or what its row takes for that (Param::swept). @throws UsageError
/// naming key, value and what is allowed.
SweepAxis parse_axis(std::string_view text);

struct SweepCase {
    std::vector<std::pair<std::string, std::string>> values;  ///< key and value per axis, in the axes' order
    Settings settings;
    std::string id;  ///< "key=value key=value": unique within a sweep
};

struct SweepPlan {
    std::vector<SweepCase> cases;
    std::size_t product = 0;         ///< cases before those that amount to the same were merged
    std::vector<std::string> notes;  ///< one line for each axis of which values make no difference here
};

/// Most cases that a sweep may have.
inline constexpr std::size_t kMaxSweepCases = 100'000;

/// The cross product of the axes over `base`. Cases that differ only in settings without effect are one case, the first
/// of them; but with an axis of scene.*, of which a scene's suggestions follow, only equal settings are. @throws
/// UsageError when a key is varied twice, by a value that stands for it too among others, or there are more than
/// kMaxSweepCases.
SweepPlan plan_sweep(const Settings& base, const std::vector<SweepAxis>& axes);

/// `settings` with each setting that is without effect at its default: two that draw the same by that are equal.
Settings without_ineffective_settings(Settings settings);

/// Without what a person looks with: overlays, panes, the map viewer. They cost time and are no part of the shadow.
Settings measured_settings(Settings settings);

}  // namespace si
