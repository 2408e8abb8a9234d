// Starting values: settings that a person's choice of bias.kind brings along, since one number suits no two kinds.
// Files, undo and set_setting() assign plainly.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"

namespace si {

/// Returns the starting values of other settings that come with the choice of bias.kind in `after`; none if `before`
/// has the same kind.
std::span<const StartingValue> starting_values(const Settings& before, const Settings& after);

/// Sets in `after` the starting values of starting_values().
/// @param held keys of settings that keep their values, since the same person set them too
void set_starting_values(const Settings& before, Settings& after, const std::set<std::string>& held = {});

/// Returns the keys of all settings that some choice of the setting `ref` sets to a starting value; empty for settings
/// other than bias.kind.
std::set<std::string> keys_with_starting_values(const SettingRef& ref);

/// Returns the settings that several --set have to name to change `a` to `b`: those that differ, then those that b's
/// bias.kind would start at another value.
std::vector<SettingRef> settings_to_set(const Settings& a, const Settings& b);

}  // namespace si
