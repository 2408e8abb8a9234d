// Reasons why a setting has no effect, and ownership of settings by techniques.
#include "renderer/settings/idle_reason.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/sources.h"
#include "renderer/settings/splits.h"

namespace si {
namespace {

/// Owners of one setting: rows of the chooser's table, and the reason for display under all other rows.
struct Ownership {
    const Param* chooser = nullptr;
    std::vector<int> rows;
    std::string reason;
};

/// Owners of all owned settings, by key of the setting.
using Ownerships = std::map<std::string_view, Ownership>;

/// Adds the settings that the rows of a table of techniques own.
/// @param chooser key of the setting that chooses a row @param rows with `key` and `settings`, in the order of choices
template <typename Rows>
void add_owners(Ownerships& out, std::string_view chooser, const Rows& rows) {
    const auto param = std::ranges::find(params(), chooser, &Param::key);
    int number = 0;
    for (const auto& row : rows) {
        for (const std::string_view key : row.settings) {
            Ownership& o = out[key];
            o.chooser = &*param;
            o.reason += fmt::format("{}{}", o.rows.empty() ? "" : " or ", row.key);
            o.rows.push_back(number);
        }
        ++number;
    }
}

/// Returns the owners of all owned settings.
Ownerships find_ownerships() {
    static constexpr std::string_view kPageSettings[] = {"map.page_size", "map.page_pool", "map.virtual_levels",
                                                         "map.virtual_bias"};
    struct Row {
        std::string_view key;
        std::span<const std::string_view> settings;
    };
    Ownerships out;
    add_owners(out, "filter.kernel", filters());
    add_owners(out, "bias.kind", biases().first(bias_choices().size()));
    add_owners(out, "light.split", splits());
    add_owners(out, "light.source", sources());
    add_owners(out, "map.virtual", std::array{Row{"off", {}}, Row{"on", kPageSettings}});
    for (auto& [key, o] : out) o.reason = fmt::format("without effect: only {} {} reads it", o.chooser->key, o.reason);
    return out;
}

}  // namespace

std::string_view unused_setting_reason(const Settings& s, const SettingRef& ref) {
    static const Ownerships all = find_ownerships();
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
