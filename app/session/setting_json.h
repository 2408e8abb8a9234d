// Conversion of setting values to and from JSON: choices by key, booleans and numbers as such.
#pragma once

#include "app/base/json_text.h"
#include "renderer/settings/param.h"

namespace si {

/// Converts the value of a setting to JSON. @param ref the setting, whose type and choices give the form
nlohmann::ordered_json setting_to_json(const SettingRef& ref, const Value& value);

/// Converts JSON to the value of a setting. @param ref the setting @throws UsageError saying what is allowed, without
/// the setting's key
Value setting_from_json(const SettingRef& ref, const nlohmann::ordered_json& json);

/// Returns the name of a setting's type for JSON and lists: "bool", "int", "float", "choice" or "text".
std::string_view setting_type(const SettingRef& ref);

}  // namespace si
