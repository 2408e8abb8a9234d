#include "app/report/fixes_json.h"

#include <fmt/format.h>

#include "renderer/base/command_text.h"
#include "renderer/reference/artefact_picture.h"

namespace si {

Json changes_json(const std::vector<std::pair<std::string, std::string>>& changes) {
    Json json = Json::object();
    for (const auto& [key, value] : changes) json[key] = value;
    return json;
}

Json change_json(const CostChange& ms) {
    return {{"difference", ms.value}, {"noise", ms.noise}, {"told", ms.is_significant()}};
}

Json fixes_json(const FixTable& table) {
    return json_list(table.rows, [&](const MeasuredFix& fix) {
        Json row = {{"name", fix.name}, {"settings", changes_json(fix.settings)}, {"tried", fix.untried.empty()}};
        if (!fix.untried.empty()) {
            row["reason"] = fix.untried;
            return row;
        }
        row["cured_px"] = fix.cured;
        row["broken_px"] = fix.broken;
        row["cured_of"] = Json::object();
        for (const ArtefactStyle& style : artefact_styles())
            if (table.wrong_of[std::size_t(style.artefact)] > 0)
                row["cured_of"][std::string(style.key)] = fix.cured_of[std::size_t(style.artefact)];
        if (fix.pixel_right) row["pixel_right"] = *fix.pixel_right;
        row["ms"] = fix.ms ? change_json(*fix.ms) : Json();
        row["map_bytes"] = fix.map_bytes;
        return row;
    });
}

void print_fixes(const FixTable& table, std::size_t rows) {
    if (table.rows.empty()) return;
    fmt::print("fixes, each drawn and measured ({} pixels are wrong now):\n", table.wrong);
    fmt::print("  {:>8} {:>8} {:>10} {:>9}\n", "cured", "broken", "time", "map");
    for (const MeasuredFix& fix : table.rows) {
        if (!fix.untried.empty()) {
            fmt::print("  {:>38}  {}: not tried, {}\n", "", fix.shown_name(), fix.untried);
            continue;
        }
        if (rows == 0) continue;
        --rows;
        fmt::print("  {:>8} {:>8} {:>10} {:>9}  {}{}\n      {}\n", fix.cured, fix.broken, time_text(fix.ms),
                   map_bytes_text(fix.map_bytes), fix.shown_name(),
                   fix.pixel_right ? *fix.pixel_right ? ": this pixel is right" : ": this pixel stays wrong" : "",
                   set_options_text(fix.settings));
    }
}

}  // namespace si
