// Validation against a JSON schema, by the words that the schemas of docs/ use.
#pragma once

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

namespace si::test {

using Schema = nlohmann::json;

inline bool obeys(const Schema& schema, const nlohmann::json& v);

/// Returns success where each member of an object obeys its part of a schema.
inline bool members_obey(const nlohmann::json& schema, const nlohmann::json& v) {
    for (const Schema& name : schema.value("required", Schema::array()))
        if (!v.contains(name.get<std::string>())) return false;
    const Schema properties = schema.value("properties", Schema::object());
    const Schema patterns = schema.value("patternProperties", Schema::object());
    for (const auto& [name, value] : v.items()) {
        const Schema* part = properties.contains(name) ? &properties[name] : nullptr;
        for (const auto& [pattern, of] : patterns.items())
            if (!part && std::regex_search(name, std::regex(pattern))) part = &of;
        if (!part && schema.contains("additionalProperties")) part = &schema["additionalProperties"];
        if (part && !obeys(*part, value)) return false;
    }
    return true;
}

/// Returns success where a value obeys a schema.
inline bool obeys(const nlohmann::json& schema, const nlohmann::json& v) {
    if (schema.is_boolean()) return schema.get<bool>();
    if (schema.contains("const")) return schema["const"] == v;
    if (schema.contains("enum")) return std::ranges::find(schema["enum"], v) != schema["enum"].end();
    if (schema["type"].is_array())
        return std::ranges::any_of(schema["type"], [&](const Schema& type) {
            return obeys(Schema{{"type", type}}, v);
        });
    const std::string type = schema["type"];
    if (type == "object") return v.is_object() && members_obey(schema, v);
    if (type == "array") {
        if (!v.is_array() || v.size() < schema.value("minItems", 0u) || v.size() > schema.value("maxItems", SIZE_MAX))
            return false;
        for (std::size_t i = 0; i < v.size(); ++i) {
            const bool listed = schema.contains("prefixItems");
            if (!listed && !schema.contains("items")) continue;
            if (!obeys(listed ? schema["prefixItems"][i] : schema["items"], v[i])) return false;
        }
        return true;
    }
    if (type == "number" || type == "integer")
        return v.is_number() && v.get<double>() >= schema.value("minimum", -1e300) &&
               v.get<double>() <= schema.value("maximum", 1e300) &&
               (!schema.contains("exclusiveMinimum") || v.get<double>() > schema["exclusiveMinimum"].get<double>());
    if (type == "string") return v.is_string() && v.get<std::string>().size() <= schema.value("maxLength", SIZE_MAX);
    return type == "boolean" && v.is_boolean();
}

}  // namespace si::test
