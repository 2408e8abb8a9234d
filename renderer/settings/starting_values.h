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

/// Returns the values that other settings get when a person changes bias.kind from its value in `before` to that in
/// `after`. Empty if both have the same kind.
std::span<const StartingValue> starting_values(const Settings& before, const Settings& after);

/// Sets in `after` the values that come with its new bias.kind, as starting_values() returns them.
/// @param held keys of settings that keep their values, since they are set explicitly along with bias.kind
void set_starting_values(const Settings& before, Settings& after, const std::set<std::string>& held = {});

/// Returns the keys of all settings that may change along with the setting `ref`: those with a starting value (one that
/// a choice of bias.kind brings along). Empty for settings other than bias.kind.
std::set<std::string> keys_with_starting_values(const SettingRef& ref);

/// Returns the settings that a command line must name with --set to turn the settings `a` into `b`. First come those
/// that differ. Then follow settings that are equal in both, but that `--set bias.kind` would change, since a new kind
/// brings along starting values.
std::vector<SettingRef> settings_to_set(const Settings& a, const Settings& b);

}  // namespace si
