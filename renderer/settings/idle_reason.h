// Settings without effect under the values of other settings. A row of a table of techniques owns the settings that
// only it reads.
#pragma once

#include <string_view>

#include "renderer/settings/param.h"

namespace si {

/// Returns a text for panels that explains why the techniques chosen by `s` do not read the setting `ref`, and names
/// the techniques that do. Empty if a chosen technique reads the setting, or if it belongs to no technique. Panels hide
/// unused settings, and results do not depend on them.
std::string_view unused_setting_reason(const Settings& s, const SettingRef& ref);
/// Returns a text for panels that explains why the setting `ref` has no effect under the settings `s`; empty if it has
/// an effect.
std::string_view idle_reason(const Settings& s, const SettingRef& ref);

}  // namespace si
