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
    }
}

struct ListKind {
    std::string_view key;
    Json (*rows)();
};

constexpr ListKind kKinds[] = {
    {"settings", setting_rows}, {"filters", filter_rows}, {"biases", bias_rows},         {"sources", source_rows},
    {"fits", fit_rows},         {"views", view_rows},     {"overlays", overlay_rows},    {"metrics", metric_rows},
    {"scenes", scene_rows},     {"presets", preset_rows}, {"hard-cases", hard_case_rows}};

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
        // Not a key but words to search for.
        for (std::size_t i = 0; i < list.size(); ++i)
            if (setting_matches(listed(params()[i]), options.prefix)) chosen.push_back(std::move(list[i]));
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
