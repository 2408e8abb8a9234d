#include "app/session/preset_schema.h"

#include <string_view>
#include <variant>

#include "app/session/setting_json.h"
#include "renderer/settings/earlier.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

/// Returns the schema of a setting's value.
Json value_schema(const SettingRef& ref) {
    const Param& p = *ref.param;
    Settings any;
    ObjectSettings object;
    const std::string_view type = setting_type(ref);
    Json out;
    if (type == "bool") {
        out["type"] = "boolean";
    } else if (type == "text") {
        out["type"] = "string";
        out["maxLength"] = std::size_t(p.max);
    } else if (type == "choice" && std::holds_alternative<EnumRef>(p.field(any, 0, &object))) {
        out["enum"] = Json::array();
        for (const Choice& choice : p.choices()) out["enum"].push_back(choice.key);
    } else if (type == "choice") {
        out["type"] = "string";
    } else {
        out["type"] = type == "int" ? "integer" : "number";
        out["minimum"] = p.min;
        out["maximum"] = p.max;
    }
    out["description"] = p.label;
    return out;
}

/// Returns a text in which characters that mean something in a regular expression are escaped.
std::string as_pattern(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '.') out += '\\';
        out += c;
    }
    return out;
}

}  // namespace

std::string preset_schema() {
    Json settings = {{"type", "object"}, {"properties", Json::object()}, {"patternProperties", Json::object()}};
    for (const Param& p : params()) {
        const SettingRef ref{&p, 0, p.scope == Scope::Object ? "PATH" : ""};
        const std::string_view last = p.key.substr(p.key.find('.') + 1);
        if (p.scope != Scope::Object) settings["properties"][std::string(p.key)] = value_schema(ref);
        if (p.scope == Scope::Light)
            settings["patternProperties"]["^light\\.([0-9]|1[0-5])\\." + as_pattern(last) + "$"] = value_schema(ref);
        if (p.scope == Scope::Object)
            settings["patternProperties"]["^object\\..+\\." + as_pattern(last) + "$"] = value_schema(ref);
    }
    settings["additionalProperties"] = false;
    Json out;
    out["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    out["title"] = "Preset of Shadow Inspector";
    out["description"] = "Settings that differ from the defaults; docs/settings.md explains each.";
    out["type"] = "object";
    Json& members = out["properties"];
    members["format"]["const"] = "shadow-inspector-preset";
    members["version"] = {{"type", "integer"}, {"minimum", oldest_settings_version()}, {"maximum", kSettingsVersion}};
    for (const char* text : {"title", "topic", "about", "scene"}) members[text]["type"] = "string";
    members["settings"] = std::move(settings);
    members["claims"]["type"] = "array";
    out["required"] = {"format", "version", "settings"};
    out["additionalProperties"] = false;
    return out.dump(1, ' ') + "\n";
}

}  // namespace si
