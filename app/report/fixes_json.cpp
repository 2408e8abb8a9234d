#include "app/report/fixes_json.h"

#include <fmt/format.h>

#include "renderer/base/command_text.h"
#include "renderer/reference/artefact_picture.h"

namespace si {

using Json = nlohmann::ordered_json;

Json fixes_json(const FixTable& table) {
    Json rows = Json::array();
    for (const MeasuredFix& fix : table.rows) {
        Json row = {{"name", fix.name}, {"settings", Json::object()}, {"tried", fix.untried.empty()}};
        for (const auto& [key, value] : fix.settings) row["settings"][key] = value;
        if (!fix.untried.empty()) {
            row["reason"] = fix.untried;
            rows.push_back(std::move(row));
            continue;
        }
        row["cured_px"] = fix.cured;
        row["broken_px"] = fix.broken;
        row["cured_of"] = Json::object();
        for (const ArtefactStyle& style : artefact_styles())
            if (table.wrong_of[std::size_t(style.artefact)] > 0)
                row["cured_of"][std::string(style.key)] = fix.cured_of[std::size_t(style.artefact)];
        if (fix.pixel_right) row["pixel_right"] = *fix.pixel_right;
        row["ms"] =
            fix.ms ? Json{{"difference", fix.ms->value}, {"noise", fix.ms->noise}, {"told", fix.ms->told()}} : Json();
        row["map_bytes"] = fix.map_bytes;
        rows.push_back(std::move(row));
    }
    return rows;
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
