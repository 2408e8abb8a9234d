#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

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

using Json = nlohmann::ordered_json;

Json row(std::string_view key, std::string_view label, std::string_view help) {
    return {{"key", key}, {"label", label}, {"help", help}};
}

/// Returns a reference to a setting as lists name it: of light 0, or of an object PATH.
SettingRef listed(const Param& p) {
    return {&p, 0, p.scope == Scope::Object ? "PATH" : ""};
}

Json setting_rows() {
    static constexpr const char* kScopes[] = {"scene", "light", "object"};
    static constexpr const char* kCosts[] = {"uniform", "program", "target"};
    Json list = Json::array();
    for (const Param& p : params()) {
        const SettingRef ref = listed(p);
        Json json = row(setting_key(ref), p.label, p.help);
        const auto type = setting_type(ref);
        const bool number = type == "int" || type == "float";
        json["also"] = p.also;
        json["type"] = type;
        json["unit"] = p.unit;
        json["min"] = number ? Json(p.min) : Json();
        json["max"] = number || type == "text" ? Json(p.max) : Json();  // for texts the largest number of bytes
        json["default"] = setting_to_json(ref, default_value(ref));
        json["choices"] = Json::array();
        if (p.choices) {
            for (const Choice& c : p.choices()) json["choices"].push_back(row(c.key, c.label, c.help));
        }
        json["logarithmic"] = p.logarithmic;
        json["scope"] = kScopes[std::size_t(p.scope)];
        json["cost"] = kCosts[std::size_t(p.cost)];
        list.push_back(std::move(json));
    }
    return list;
}

/// Converts the rows of a table of techniques to JSON. @param more adds members of this table only: (Json&, const Row&)
template <typename Row>
Json technique_rows(std::span<const Row> rows, auto&& more) {
    Json list = Json::array();
    for (const Row& r : rows) {
        Json json = row(r.key, r.label, r.help);
        json["paper"] = r.paper;
        more(json, r);
        list.push_back(std::move(json));
    }
    return list;
}

Json filter_rows() {
    return technique_rows(filters(), [](Json& json, const Filter& f) {
        json["file"] = f.file;
        const Reach reach = f.reach(f, Settings{}, std::numeric_limits<double>::infinity());
        const FilterCost cost = f.cost(f, Settings{});
        json["size"] = taps_across(f, Settings{});
        json["bilinear"] = is_bilinear(f, Settings{});
        json["reach_texels"] = reach.bias;
        json["edge_reach_texels"] = reach.edge;
        json["read_reach_texels"] = reach.read;
        json["gathers"] = cost.gathers;
        json["sampler_taps"] = cost.sampler_taps;
        json["settings"] = std::vector<std::string>(f.settings.begin(), f.settings.end());
    });
}

Json bias_rows() {
    static constexpr const char* kStages[] = {"compare", "look-up", "raster"};
    return technique_rows(biases(), [](Json& json, const Bias& b) {
        json["file"] = b.file;
        json["stage"] = kStages[std::size_t(b.stage)];
        json["settings"] = b.settings;
        json["per_texel"] = b.per_texel;
        json["brings_need"] = b.gives_needed_bias;
    });
}

Json fit_rows() {
    return technique_rows(fits(), [](Json& json, const FitRow& f) {
        json["reads_camera"] = f.reads_camera;
        json["narrows"] = f.narrows;
    });
}

Json source_rows() {
    return technique_rows(sources(), [](Json& json, const Source& s) {
        json["file"] = s.file;
        json["fused"] = s.fused;
    });
}

Json metric_rows() {
    return technique_rows(metrics(), [](Json& json, const Metric& m) {
        json["unit"] = m.unit;
        json["formula"] = m.formula;
    });
}

Json overlay_rows() {
    return technique_rows(overlays(), [](Json& json, const Overlay& o) {
        json["file"] = o.file();
        json["unit"] = o.unit;
        json["scalar"] = o.scalar;
        json["min"] = o.min;
        json["max"] = o.max;
        json["diverging"] = o.diverging;
    });
}

Json view_rows() {
    Json list = Json::array();
    for (const View& v : views()) {
        Json json = row(v.key, v.label, v.help);
        json["scalar"] = v.scalar;
        list.push_back(std::move(json));
    }
    return list;
}

Json scene_rows() {
    Json list = Json::array();
    for (const BuiltinScene& s : builtin_scenes()) list.push_back(row(s.key, s.label, s.help));
    return list;
}

Json preset_rows() {
    Json list = Json::array();
    for (const BuiltinPreset& p : builtin_presets()) {
        Json json = row(p.key, p.title.empty() ? p.key : p.title, p.about);
        json["topic"] = p.topic;
        json["scene"] = p.scene;
        list.push_back(std::move(json));
    }
    return list;
}

Json hard_case_rows() {
    Json list = Json::array();
    for (const HardCase& c : hard_cases()) {
        Json json = row(HardCaseView{&c, false}.name(), c.title, c.fault);
        json["number"] = c.number;
        json["remedy"] = c.fix;
        json["measure"] = c.measure;
        json["limit"] = c.limit;
        json["unit"] = c.unit;
        json["why"] = c.limit_reason;
        json["fixed"] = HardCaseView{&c, true}.name();
        list.push_back(std::move(json));
    }
    return list;
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
        for (const Json& c : r["choices"]) {
            fmt::print("      {:<14} {}\n", c["key"].get<std::string>(), c["help"].get<std::string>());
        }
    }
}

}  // namespace

namespace {

struct ListKind {
    std::string key;
    Json (*rows)();
};

const std::vector<ListKind>& kinds_of_lists() {
    static const std::vector<ListKind> kinds = {
        {"settings", setting_rows}, {"filters", filter_rows}, {"biases", bias_rows},         {"sources", source_rows},
        {"fits", fit_rows},         {"views", view_rows},     {"overlays", overlay_rows},    {"metrics", metric_rows},
        {"scenes", scene_rows},     {"presets", preset_rows}, {"hard-cases", hard_case_rows}};
    return kinds;
}

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

const std::vector<std::string>& list_kinds() {
    static const std::vector<std::string> kinds = [] {
        std::vector<std::string> out;
        for (const ListKind& k : kinds_of_lists()) out.push_back(k.key);
        return out;
    }();
    return kinds;
}

void run_list(const ListOptions& options) {
    const std::string& kind = options.kind;
    const auto known = std::ranges::find(kinds_of_lists(), kind, &ListKind::key);
    if (known == kinds_of_lists().end()) {
        throw UsageError(fmt::format("list {}: it is one of {}{}", kind, fmt::join(list_kinds(), ", "),
                                     did_you_mean(nearest_name(kind, list_kinds()))));
    }
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
    if (options.json) {
        fmt::print("{}", json_text(chosen));
    } else if (kind == "presets") {
        print_presets(chosen);
    } else {
        print_rows(chosen);
    }
}

std::string settings_help() {
    std::string text = "Settings (--set KEY=VALUE; `list settings [KEY]` explains each):\n";
    for (const Json& r : setting_rows()) {
        text += fmt::format("  {:<26} {}  [{}]\n", r["key"].get<std::string>(), range_text(r), plain(r["default"]));
    }
    return text;
}

}  // namespace si
