// Settings without effect under the values of others.
#pragma once

#include <string_view>

#include "renderer/settings/param.h"

namespace si {

/// Returns why the setting is without effect under `s`, or an empty text.
std::string_view idle_reason(const Settings& s, const SettingRef& ref);

}  // namespace si
