// Settings without effect under the values of other settings. A row of a table of techniques owns the settings that
// only it reads.
#pragma once

#include <string_view>

#include "renderer/settings/param.h"

namespace si {

/// Returns the reason, as a text for panels, why the techniques chosen by `s` (kernel, bias, source, ...) do not read
/// the setting `ref`. The text names the techniques that do. Empty if a chosen technique reads the setting, or if the
/// setting belongs to no technique. Panels hide unused settings, and results do not depend on them.
std::string_view unused_setting_reason(const Settings& s, const SettingRef& ref);
/// Returns the reason, as a text for panels, why the setting `ref` has no effect under the settings `s`. Empty if it
/// has an effect.
std::string_view idle_reason(const Settings& s, const SettingRef& ref);

}  // namespace si
