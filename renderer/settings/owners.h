// Which settings belong to which techniques: a row of a table of techniques lists the keys that are its own.
#pragma once

#include <string>
#include <string_view>

#include "renderer/settings/param.h"

namespace si {

/// Why a setting is no part of the techniques that `s` chooses, naming those that read it; empty when it is, or when
/// it belongs to none. Such settings are not shown, left out of what results depend on, and the same in sweeps.
std::string_view unused_setting_reason(const Settings& s, const SettingRef& ref);

}  // namespace si
