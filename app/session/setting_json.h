// Conversion of setting values to and from JSON: choices by key, booleans and numbers as such.
#pragma once

#include "app/base/json_text.h"
#include "renderer/settings/param.h"

namespace si {

/// Converts a setting's value to JSON. @param ref the setting, for its type and choices
nlohmann::ordered_json setting_to_json(const SettingRef& ref, const Value& value);

/// Converts JSON to a setting's value. @throws UsageError saying what is allowed, without the setting's key
Value setting_from_json(const SettingRef& ref, const nlohmann::ordered_json& json);

/// Returns the name of a setting's type: "bool", "int", "float" or "choice".
std::string_view setting_type(const SettingRef& ref);

}  // namespace si
