#include "renderer/settings/owners.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/splits.h"

namespace si {
namespace {

/// A setting that chooses a row of a table, and what each row owns.
struct TechniqueTable {
    std::string_view chooser;  ///< key of the setting
    struct Row {
        std::string_view key;
        std::span<const std::string_view> settings;
    };
    std::vector<Row> rows;
};

/// @param choices of the chooser, which may be fewer than the table's rows
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
            {"map.virtual", {{"off", {}}, {"on", kPageSettings}}}};
}

struct Ownership {
    const Param* chooser = nullptr;
    std::vector<int> rows;
    std::string reason;
};

/// By key of the owned setting.
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

std::string_view not_owned(const Settings& s, const SettingRef& ref) {
    static const std::map<std::string_view, Ownership> all = find_ownerships();
    const auto found = all.find(ref.param->key);
    if (found == all.end()) return {};
    const Ownership& o = found->second;
    const Value chosen = get_value(s, {o.chooser, ref.light, ref.object});
    const int row = std::visit([](auto v) { return int(v); }, chosen);
    return std::ranges::find(o.rows, row) != o.rows.end() ? std::string_view() : std::string_view(o.reason);
}

}  // namespace si
