// Values of settings as JSON: choices by key, booleans and numbers as such.
#pragma once

#include <nlohmann/json.hpp>

#include "renderer/settings/param.h"

namespace si {

nlohmann::ordered_json setting_to_json(const SettingRef& ref, const Value& value);

/// @throws UsageError saying what is allowed, without the setting's key.
Value setting_from_json(const SettingRef& ref, const nlohmann::ordered_json& json);

/// "bool", "int", "float" or "choice".
std::string_view setting_type(const SettingRef& ref);

}  // namespace si
