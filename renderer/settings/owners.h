// Ownership of settings by techniques: a row of a table of techniques lists the keys that only it reads.
#pragma once

#include <string>
#include <string_view>

#include "renderer/settings/param.h"

namespace si {

/// Returns the reason for display why the techniques chosen by `s` do not read the setting `ref`; it names the
/// techniques that do. Empty if a chosen technique reads the setting, or if no technique owns it. Panels hide unused
/// settings, and results do not depend on them.
std::string_view unused_setting_reason(const Settings& s, const SettingRef& ref);

}  // namespace si
