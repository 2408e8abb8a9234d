#include "app/report/cures_json.h"

#include <fmt/format.h>

#include "renderer/base/command_text.h"
#include "renderer/measure/artefact_picture.h"

namespace si {

using Json = nlohmann::ordered_json;

Json cures_json(const CureTable& table) {
    Json rows = Json::array();
    for (const Cure& cure : table.rows) {
        Json row = {{"name", cure.name}, {"settings", Json::object()}, {"tried", cure.untried.empty()}};
        for (const auto& [key, value] : cure.settings) row["settings"][key] = value;
        if (!cure.untried.empty()) {
            row["reason"] = cure.untried;
            rows.push_back(std::move(row));
            continue;
        }
        row["cured_px"] = cure.cured;
        row["broken_px"] = cure.broken;
        row["cured_of"] = Json::object();
        for (const ArtefactStyle& style : artefact_styles())
            if (table.wrong_of[std::size_t(style.artefact)] > 0)
                row["cured_of"][std::string(style.key)] = cure.cured_of[std::size_t(style.artefact)];
        if (cure.pixel_right) row["pixel_right"] = *cure.pixel_right;
        row["ms"] = cure.ms ? Json{{"difference", cure.ms->value}, {"noise", cure.ms->noise}, {"told", cure.ms->told()}}
                            : Json();
        row["map_bytes"] = cure.map_bytes;
        rows.push_back(std::move(row));
    }
    return rows;
}

void print_cures(const CureTable& table, std::size_t rows) {
    if (table.rows.empty()) return;
    fmt::print("cures, each drawn and measured ({} pixels are wrong now):\n", table.wrong);
    fmt::print("  {:>8} {:>8} {:>10} {:>9}\n", "cured", "broken", "time", "map");
    for (const Cure& cure : table.rows) {
        if (!cure.untried.empty()) {
            fmt::print("  {:>38}  {}: not tried, {}\n", "", cure.shown_name(), cure.untried);
            continue;
        }
        if (rows == 0) continue;
        --rows;
        fmt::print("  {:>8} {:>8} {:>10} {:>9}  {}{}\n      {}\n", cure.cured, cure.broken, time_text(cure.ms),
                   map_bytes_text(cure.map_bytes), cure.shown_name(),
                   cure.pixel_right ? *cure.pixel_right ? ": this pixel is right" : ": this pixel stays wrong" : "",
                   set_options_text(cure.settings));
    }
}

}  // namespace si
