#include "app/session/setting_json.h"

#include <fmt/format.h>

#include "renderer/base/error.h"

namespace si {

std::string_view setting_type(const SettingRef& ref) {
    if (ref.param->choices) return "choice";
    if (is_text(*ref.param)) return "text";
    const Value v = default_value(ref);
    return std::holds_alternative<bool>(v) ? "bool" : std::holds_alternative<int>(v) ? "int" : "float";
}

Json setting_to_json(const SettingRef& ref, const Value& value) {
    if (ref.param->choices) return value_text(*ref.param, value);
    return std::visit([](const auto& v) { return Json(v); }, value);
}

Value setting_from_json(const SettingRef& ref, const Json& json) {
    const auto type = setting_type(ref);
    const bool words = type == "choice" || type == "text";
    const bool fits = words ? json.is_string() : type == "bool" ? json.is_boolean() : json.is_number();
    if (!fits) {
        const auto wanted = type == "choice" ? "one of its choices as a text"
                            : type == "text" ? "a text"
                            : type == "bool" ? "true or false"
                                             : "a number";
        throw UsageError(fmt::format("wrong type: {} is wanted, not {}", wanted, quoted(json)));
    }
    if (type == "bool") return json.get<bool>();
    const std::string text = words                      ? json.get<std::string>()
                             : json.is_number_integer() ? json.dump()
                                                        : value_text(*ref.param, json.get<double>());
    try {
        return parse_value(ref, text);
    } catch (const UsageError& e) {
        const std::string message = e.what(), key = setting_key(ref) + ": ";
        throw UsageError(message.starts_with(key) ? message.substr(key.size()) : message);
    }
}

}  // namespace si
