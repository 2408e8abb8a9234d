// Reasons why a setting has no effect, and ownership of settings by techniques.
#include "renderer/settings/idle_reason.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/sources.h"
#include "renderer/settings/splits.h"

namespace si {
namespace {

/// Table of techniques: the setting that chooses a row, and the settings that each row owns.
struct TechniqueTable {
    std::string_view chooser;  ///< key of the setting
    struct Row {
        std::string_view key;
        std::span<const std::string_view> settings;
    };
    std::vector<Row> rows;
};

/// Returns the ownership table of a chooser setting.
/// @param choices number of the chooser's choices, at most the number of rows
template <typename Rows>
TechniqueTable table_of(std::string_view chooser, const Rows& rows, std::size_t choices) {
    TechniqueTable table{chooser, {}};
    for (const auto& row : rows.first(choices)) table.rows.push_back({row.key, row.settings});
    return table;
}

constexpr std::string_view kPageSettings[] = {"map.page_size", "map.page_pool", "map.virtual_levels",
                                              "map.virtual_bias"};

std::vector<TechniqueTable> technique_tables() {
    return {table_of("filter.kernel", filters(), filters().size()),
            table_of("bias.kind", biases(), bias_choices().size()),
            table_of("light.split", splits(), splits().size()),
            table_of("light.source", sources(), sources().size()),
            {"map.virtual", {{"off", {}}, {"on", kPageSettings}}}};
}

/// Owners of one setting: rows of the chooser's table, and the reason for display under all other rows.
struct Ownership {
    const Param* chooser = nullptr;
    std::vector<int> rows;
    std::string reason;
};

/// Returns the owners of all owned settings, by key of the setting.
std::map<std::string_view, Ownership> find_ownerships() {
    std::map<std::string_view, Ownership> out;
    for (const TechniqueTable& table : technique_tables()) {
        const auto chooser = std::ranges::find(params(), table.chooser, &Param::key);
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            for (const std::string_view key : table.rows[i].settings) {
                Ownership& o = out[key];
                o.chooser = &*chooser;
                o.reason += fmt::format("{}{}", o.rows.empty() ? "" : " or ", table.rows[i].key);
                o.rows.push_back(int(i));
            }
    }
    for (auto& [key, o] : out) o.reason = fmt::format("without effect: only {} {} reads it", o.chooser->key, o.reason);
    return out;
}

}  // namespace

std::string_view unused_setting_reason(const Settings& s, const SettingRef& ref) {
    static const std::map<std::string_view, Ownership> all = find_ownerships();
    const auto found = all.find(ref.param->key);
    if (found == all.end()) return {};
    const Ownership& o = found->second;
    // A setting shared by all lights counts as read if the technique of any light reads it.
    const bool shared = o.chooser->scope == Scope::Light && ref.param->scope != Scope::Light;
    const int first = shared ? 0 : ref.light, last = shared ? std::clamp(s.light_count, 0, kMaxLights) - 1 : ref.light;
    for (int light = first; light <= last; ++light) {
        const Value chosen = get_value(s, {o.chooser, light, ref.object});
        if (std::ranges::find(o.rows, int(numeric_value(chosen))) != o.rows.end()) return {};
    }
    return o.reason;
}

std::string_view idle_reason(const Settings& s, const SettingRef& ref) {
    if (ref.param->scope == Scope::Light && ref.light >= s.light_count) return "without effect: the light is off";
    if (ref.param->map_only && no_source_is_map(s))
        return "without effect: no light's shadows come from a map (light.source)";
    if (const std::string_view reason = unused_setting_reason(s, ref); !reason.empty()) return reason;
    return ref.param->idle ? ref.param->idle(s, ref.light) : std::string_view();
}

}  // namespace si
