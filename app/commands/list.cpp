#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "app/base/json_text.h"
#include "app/commands/commands.h"
#include "app/report/report.h"
#include "app/report/views.h"
#include "app/session/presets.h"
#include "app/session/setting_json.h"
#include "renderer/base/did_you_mean.h"
#include "renderer/base/error.h"
#include "renderer/profiles/engine_wording.h"
#include "renderer/reference/metrics.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/hard_cases.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/fits.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"
#include "renderer/settings/search.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

/// Returns a row of a table. @param more members of this table only, an object
Json row(std::string_view key, std::string_view label, std::string_view help, const Json& more = Json::object()) {
    Json json = {{"key", key}, {"label", label}, {"help", help}};
    json.update(more);
    return json;
}

/// Returns a reference to a setting as lists name it: of light 0, or of an object PATH.
SettingRef listed(const Param& p) {
    return {&p, 0, p.scope == Scope::Object ? "PATH" : ""};
}

Json choice_row(const Choice& c) {
    return row(c.key, c.label, c.help);
}

Json setting_row(const Param& p) {
    static constexpr const char* kScopes[] = {"scene", "light", "object"};
    static constexpr const char* kCosts[] = {"uniform", "program", "target"};
    const SettingRef ref = listed(p);
    const auto type = setting_type(ref);
    const bool number = type == "int" || type == "float";
    return row(setting_key(ref), p.label, p.help,
               {{"also", p.also},
                {"type", type},
                {"unit", p.unit},
                {"min", number ? Json(p.min) : Json()},
                {"max", number || type == "text" ? Json(p.max) : Json()},  // for texts the largest number of bytes
                {"default", setting_to_json(ref, default_value(ref))},
                {"choices", p.choices ? json_list(p.choices(), choice_row) : Json::array()},
                {"logarithmic", p.logarithmic},
                {"scope", kScopes[std::size_t(p.scope)]},
                {"cost", kCosts[std::size_t(p.cost)]}});
}

Json setting_rows() {
    return json_list(params(), setting_row);
}

/// Converts the rows of a table of techniques to JSON. @param more returns members of this table only
template <typename Row>
Json technique_rows(std::span<const Row> rows, Json (*more)(const Row&)) {
    return json_list(rows, [&](const Row& r) {
        Json members = {{"paper", r.paper}};
        members.update(more(r));
        return row(r.key, r.label, r.help, members);
    });
}

Json filter_rows() {
    return technique_rows<Filter>(filters(), [](const Filter& f) -> Json {
        const Reach reach = f.reach(f, Settings{}, std::numeric_limits<double>::infinity());
        const FilterCost cost = f.cost(f, Settings{});
        return {{"file", f.file},
                {"size", taps_across(f, Settings{})},
                {"bilinear", is_bilinear(f, Settings{})},
                {"reach_texels", reach.bias},
                {"edge_reach_texels", reach.edge},
                {"read_reach_texels", reach.read},
                {"gathers", cost.gathers},
                {"sampler_taps", cost.sampler_taps},
                {"settings", std::vector<std::string>(f.settings.begin(), f.settings.end())}};
    });
}

Json bias_rows() {
    return technique_rows<Bias>(biases(), [](const Bias& b) -> Json {
        static constexpr const char* kStages[] = {"compare", "look-up", "raster"};
        Json starts = Json::object();
        for (const StartingValue& start : b.starts) starts[std::string(start.key)] = start.value;
        return {{"file", b.file},           {"stage", kStages[std::size_t(b.stage)]},
                {"settings", b.settings},   {"starts", starts},
                {"per_texel", b.per_texel}, {"brings_need", b.gives_needed_bias}};
    });
}

Json fit_rows() {
    return technique_rows<FitRow>(fits(), [](const FitRow& f) -> Json {
        return {{"reads_camera", f.reads_camera}, {"narrows", f.narrows}};
    });
}

Json source_rows() {
    return technique_rows<Source>(sources(), [](const Source& s) -> Json {
        return {{"file", s.file}, {"fused", s.fused}};
    });
}

Json metric_rows() {
    return technique_rows<Metric>(metrics(), [](const Metric& m) -> Json {
        return {{"unit", m.unit}, {"formula", m.formula}};
    });
}

Json overlay_rows() {
    return technique_rows<Overlay>(overlays(), [](const Overlay& o) -> Json {
        return {{"file", o.file()}, {"unit", o.unit}, {"scalar", o.scalar},
                {"min", o.min},     {"max", o.max},   {"diverging", o.diverging}};
    });
}

Json view_rows() {
    return json_list(views(), [](const View& v) { return row(v.key, v.label, v.help, {{"scalar", v.scalar}}); });
}

Json scene_rows() {
    return json_list(builtin_scenes(), [](const BuiltinScene& s) { return row(s.key, s.label, s.help); });
}

Json preset_rows() {
    return json_list(builtin_presets(), [](const BuiltinPreset& p) {
        return row(p.key, p.title.empty() ? p.key : p.title, p.about, {{"topic", p.topic}, {"scene", p.scene}});
    });
}

Json profile_rows() {
    return json_list(engine_profiles(), [](const EngineProfile& p) {
        const std::string help =
            fmt::format("{}, {}{}", p.title, p.version,
                        p.unverified.empty() ? "" : fmt::format(". Not verified: {}", p.unverified));
        return row(p.name, p.title, help,
                   {{"version", p.version}, {"unverified", p.unverified}, {"converts", p.read_bias != nullptr}});
    });
}

/// Returns the parameter's equivalent under the facts of docs/profiles.md; an object without members where there is
/// none.
Json equivalent_json(const EngineProfile& profile, const EngineParameter& parameter) {
    if (!parameter.is_bias || !profile.read_bias) return Json::object();
    EngineValues values;
    for (const EngineParameter& other : profile.parameters)
        if (other.is_bias && &other != &parameter) values[std::string(other.key)] = std::max(0.0, other.min);
    const double without = [&] {
        EngineValues zero = values;
        zero[std::string(parameter.key)] = std::max(0.0, parameter.min);
        return engine_bias_texels(profile, zero, {});
    }();
    values[std::string(parameter.key)] = parameter.standard;
    const double texels = engine_bias_texels(profile, values, {}) - without;
    return {{"texels", texels}, {"metres", texels * MapFacts{}.texel_m()}};
}

Json parameter_rows(const EngineProfile& profile) {
    return json_list(profile.parameters, [&](const EngineParameter& p) {
        Json choices = Json::array();
        for (const EngineChoice& c : p.choices) choices.push_back({{"key", c.key}, {"settings", c.settings}});
        return Json{{"key", p.key},
                    {"unit", p.unit},
                    {"default", p.choices.empty() ? Json(p.standard) : Json(engine_value_text(p, p.standard))},
                    {"min", p.min},
                    {"max", p.max},
                    {"choices", choices},
                    {"help", p.meaning},
                    {"source", p.source},
                    {"setting", p.setting},
                    {"bias", p.is_bias},
                    {"default_equivalent", equivalent_json(profile, p)}};
    });
}

/// Returns all that is known of one profile.
Json profile_json(const EngineProfile& profile) {
    const MapFacts facts;
    return {{"name", profile.name},
            {"title", profile.title},
            {"version", profile.version},
            {"unverified", profile.unverified},
            {"converts", profile.read_bias != nullptr},
            {"hidden_texels", profile.hidden_texels ? profile.hidden_texels(profile, {}, facts) : 0},
            {"facts",
             {{"width_m", facts.width_m},
              {"texels", facts.texels},
              {"depth_m", facts.depth_m},
              {"angle_deg", facts.angle_deg}}},
            {"parameters", parameter_rows(profile)},
            {"forced", json_list(profile.forced,
                                 [](const ForcedSetting& f) {
                                     return Json{{"setting", f.key}, {"value", f.value}, {"reason", f.reason}};
                                 })},
            {"lacking", json_list(profile.lacking, [](const LackingSetting& l) {
                 return Json{{"setting", l.key}, {"value", l.value}, {"reason", l.reason}};
             })}};
}

Json hard_case_rows() {
    return json_list(hard_cases(), [](const HardCase& c) {
        return row(HardCaseView{&c, false}.name(), c.title, c.fault,
                   {{"number", c.number},
                    {"remedy", c.fix},
                    {"measure", c.measure},
                    {"limit", c.limit},
                    {"unit", c.unit},
                    {"why", c.limit_reason},
                    {"fixed", HardCaseView{&c, true}.name()}});
    });
}

std::string range_text(const Json& setting) {
    if (setting["type"] == "bool") return "true false";
    if (setting["type"] == "text") return fmt::format("a text of at most {:g} bytes", setting["max"].get<double>());
    if (setting["type"] == "choice") {
        std::vector<std::string> keys;
        for (const Json& c : setting["choices"]) keys.push_back(c["key"]);
        return fmt::format("{}", fmt::join(keys, " "));
    }
    const std::string unit = setting["unit"];
    return fmt::format("{:g} to {:g}{}{}", setting["min"].get<double>(), setting["max"].get<double>(),
                       unit.empty() ? "" : " ", unit);
}

std::string plain(const Json& value) {
    if (value == "") return "none";
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Prints all that is known of one profile.
void print_profile(const Json& p) {
    fmt::print("{}: {}, {}\n", p["name"].get<std::string>(), p["title"].get<std::string>(),
               p["version"].get<std::string>());
    if (p["unverified"] != "") fmt::print("not verified: {}\n", p["unverified"].get<std::string>());
    if (!p["converts"].get<bool>()) fmt::print("no conversion is known: --profile refuses this engine\n");
    const Json& facts = p["facts"];
    fmt::print("equivalents are for a map of {:g} m and {} texels with a depth range of {:g} m, at {:g} degrees\n",
               facts["width_m"].get<double>(), facts["texels"].get<int>(), facts["depth_m"].get<double>(),
               facts["angle_deg"].get<double>());
    if (const double hidden = p["hidden_texels"]; hidden != 0) fmt::print("hidden bias: {:.3g} texels\n", hidden);
    fmt::print("parameters (--set engine.NAME=VALUE)\n");
    for (const Json& r : p["parameters"]) {
        const std::string unit = r["unit"], setting = r["setting"];
        std::string range = fmt::format("{:g} to {:g}", r["min"].get<double>(), r["max"].get<double>());
        if (!r["choices"].empty()) {
            range.clear();
            for (const Json& c : r["choices"]) range += (range.empty() ? "" : " ") + c["key"].get<std::string>();
        }
        const Json& same = r["default_equivalent"];
        fmt::print("  {}  ({}{}{}; default {}{}{})\n      {}\n", r["key"].get<std::string>(), range,
                   unit.empty() ? "" : " ", unit, plain(r["default"]),
                   same.empty() ? ""
                                : fmt::format(" = {:.3g} texels = {:.3g} m", same["texels"].get<double>(),
                                              same["metres"].get<double>()),
                   setting.empty() ? "" : "; as " + setting, r["help"].get<std::string>());
    }
    for (const Json& r : p["forced"])
        fmt::print("cannot be turned off: {}={}, since {}\n", r["setting"].get<std::string>(),
                   r["value"].get<std::string>(), r["reason"].get<std::string>());
    for (const Json& r : p["lacking"]) {
        const std::string value = r["value"];
        fmt::print("is missing: {}{}{}: {}\n", r["setting"].get<std::string>(), value.empty() ? "" : "=", value,
                   r["reason"].get<std::string>());
    }
}

/// Prints presets under their topics, each with title, scene and description.
void print_presets(const Json& list) {
    std::string topic;
    std::size_t widest = 0;
    for (const Json& r : list) widest = std::max(widest, r["key"].get_ref<const std::string&>().size());
    for (const Json& r : list) {
        if (r["topic"] != topic) fmt::print("{}\n", topic = r["topic"]);
        fmt::print("  {:<{}}  {} ({})\n      {}\n", r["key"].get<std::string>(), widest, r["label"].get<std::string>(),
                   r["scene"].get<std::string>(), r["help"].get<std::string>());
    }
}

void print_rows(const Json& list) {
    for (const Json& r : list) {
        if (!r.contains("type")) {
            fmt::print("{:<18} {}\n", r["key"].get<std::string>(), r["help"].get<std::string>());
            if (const std::string paper = r.value("paper", ""); !paper.empty()) fmt::print("{:<18} {}\n", "", paper);
            continue;
        }
        fmt::print("{}  ({}; default {})\n    {}\n", r["key"].get<std::string>(), range_text(r), plain(r["default"]),
                   r["help"].get<std::string>());
        for (const Json& c : r["choices"])
            fmt::print("      {:<14} {}\n", c["key"].get<std::string>(), c["help"].get<std::string>());
        for (const Json& line : r.value("engines", Json::array())) fmt::print("    {}\n", line.get<std::string>());
    }
}

struct ListKind {
    std::string_view key;
    Json (*rows)();
};

constexpr ListKind kKinds[] = {
    {"settings", setting_rows}, {"filters", filter_rows}, {"biases", bias_rows},          {"sources", source_rows},
    {"fits", fit_rows},         {"views", view_rows},     {"overlays", overlay_rows},     {"metrics", metric_rows},
    {"scenes", scene_rows},     {"presets", preset_rows}, {"hard-cases", hard_case_rows}, {"profiles", profile_rows}};

/// Returns a key, or its beginning, in the form of the table's rows, which stand for all lights and all objects.
std::string row_key(const std::string& asked) {
    if (const auto ref = find_setting(asked)) return setting_key(listed(*ref->param));
    constexpr std::string_view kLight = "light.";
    const auto dot = asked.find('.', kLight.size());
    if (!asked.starts_with(kLight) || dot == std::string::npos) return asked;
    int number = -1;
    const char* const end = asked.data() + dot;
    const auto read = std::from_chars(asked.data() + kLight.size(), end, number);
    if (read.ptr != end || number < 0 || number >= kMaxLights) return asked;
    return std::string(kLight) + asked.substr(dot + 1);
}

}  // namespace

std::vector<std::string> list_kinds() {
    std::vector<std::string> keys;
    for (const ListKind& k : kKinds) keys.emplace_back(k.key);
    return keys;
}

void run_list(const ListOptions& options) {
    const std::string& kind = options.kind;
    if (kind == "profile") {
        if (options.prefix.empty()) throw UsageError("list profile: name one of `list profiles`");
        const Json profile = profile_json(engine_profile(options.prefix));
        if (options.json)
            fmt::print("{}", json_text(profile));
        else
            print_profile(profile);
        return;
    }
    const auto known = std::ranges::find(kKinds, kind, &ListKind::key);
    if (known == std::end(kKinds))
        throw UsageError(fmt::format("list {}: it is one of {}{}", kind, fmt::join(list_kinds(), ", "),
                                     did_you_mean(nearest_name(kind, list_kinds()))));
    const std::string prefix = kind == "settings" ? row_key(options.prefix) : options.prefix;
    Json list = known->rows();
    Json chosen = Json::array();
    for (Json& r : list) {
        if (r["key"].get<std::string>().starts_with(prefix)) chosen.push_back(std::move(r));
    }
    if (chosen.empty() && kind == "settings") {
        // Not a key but words to search for, or the name of an engine's parameter.
        for (std::size_t i = 0; i < list.size(); ++i) {
            const SettingRef ref = listed(params()[i]);
            const bool is_engines = engine_name_matches(ref, options.prefix);
            if (!is_engines && !setting_matches(ref, options.prefix)) continue;
            if (is_engines) list[i]["engines"] = engine_names_of(ref, options.prefix);
            chosen.push_back(std::move(list[i]));
        }
    }
    if (chosen.empty() && !options.prefix.empty()) {
        const bool settings = kind == "settings";
        throw UsageError(fmt::format("list {}: no key starts with '{}'{}{}", kind, options.prefix,
                                     settings ? ", and no setting is found by these words" : "",
                                     settings ? did_you_mean(nearest_key(options.prefix)) : ""));
    }
    if (options.json)
        fmt::print("{}", json_text(chosen));
    else if (kind == "presets")
        print_presets(chosen);
    else
        print_rows(chosen);
}

std::string settings_help() {
    std::string text = "Settings (--set KEY=VALUE; `list settings [KEY]` explains each):\n";
    for (const Json& r : setting_rows())
        text += fmt::format("  {:<26} {}  [{}]\n", r["key"].get<std::string>(), range_text(r), plain(r["default"]));
    return text;
}

}  // namespace si
