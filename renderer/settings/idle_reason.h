// Settings without effect under the values of other settings.
#pragma once

#include <string_view>

#include "renderer/settings/param.h"

namespace si {

/// Returns the reason for display why the setting `ref` has no effect under the settings `s`; empty if it has an
/// effect.
std::string_view idle_reason(const Settings& s, const SettingRef& ref);

}  // namespace si
