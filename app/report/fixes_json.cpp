#include "app/report/fixes_json.h"

#include <fmt/format.h>

#include <algorithm>

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

Json written_parameter_json(const ConvertedParameter& p) {
    return {{"value", p.value},
            {"unit", p.parameter->unit},
            {"exactness", kExactnessKeys[std::size_t(p.exactness)]},
            {"texels", p.texels},
            {"metres", p.metres}};
}

Json engine_changes_json(const EngineWording& engine, const std::vector<std::pair<std::string, std::string>>& changes) {
    const std::vector<ConvertedParameter> changed = engine.changed(changes);
    if (changed.empty()) return {};
    Json parameters = Json::object();
    for (const ConvertedParameter& p : changed) parameters[std::string(p.parameter->key)] = written_parameter_json(p);
    return {{"profile", engine.profile->name}, {"text", engine.text(changes)}, {"parameters", parameters}};
}

Json fixes_json(const FixTable& table, const EngineWording& engine) {
    return json_list(table.rows, [&](const Trial& t) {
        Json row = {
            {"name", t.candidate.name}, {"settings", changes_json(t.changes)}, {"tried", t.is_drawn()}, {"fix", false}};
        if (engine.profile) row["engine"] = engine_changes_json(engine, t.changes);
        if (!t.is_drawn()) {
            row["reason"] = t.candidate.untried;
            return row;
        }
        row["fix"] = t.why_not.empty();
        row["own_map"] = t.on_own_map;
        row["why_not"] = t.why_not.empty() ? Json() : Json(t.why_not);
        row["cured_px"] = t.cured;
        row["broken_px"] = t.broken;
        row["wrong_px"] = wrong_pixels(t.metrics);
        row["error"] = {{"before", t.before.error}, {"after", t.after.error}};
        row["any_acne"] = t.metrics.any_acne;
        row["any_leak"] = t.metrics.any_leak;
        row["cured_of"] = Json::object();
        for (const ArtefactStyle& style : artefact_styles())
            if (table.wrong_of[std::size_t(style.artefact)] > 0)
                row["cured_of"][std::string(style.key)] = t.cured_of[std::size_t(style.artefact)];
        if (t.pixel) {
            row["pixel_right"] = t.pixel->right;
            row["visibility"] = t.pixel->visibility;
        }
        row["ms"] = t.ms ? change_json(*t.ms) : Json();
        row["map_bytes"] = t.map_bytes();
        return row;
    });
}

std::string refused_text(std::size_t count, const EngineWording& engine) {
    return fmt::format("{} {} that {} lacks {} not tried", count, count == 1 ? "change" : "changes",
                       engine.profile ? engine.profile->title : "the engine", count == 1 ? "was" : "were");
}

void print_fixes(const FixTable& table, std::size_t rows, const EngineWording& engine) {
    if (table.rows.empty()) return;
    const auto print_engine = [&](const Trial& t) {
        if (const std::string text = engine.text(t.changes); !text.empty()) fmt::print("      {}\n", text);
    };
    if (const Trial* fix = table.fix()) {
        fmt::print("fix: {}{}: {} px wrong instead of {}, mean error {:.4g} instead of {:.4g}\n      {}\n",
                   fix->candidate.shown_name(),
                   fix->pixel ? fmt::format(": visibility {:.2f}, {:.2f} is right", fix->pixel->visibility,
                                            fix->pixel->reference)
                              : "",
                   wrong_pixels(fix->metrics), table.wrong, fix->after.error, fix->before.error,
                   set_options_text(fix->changes));
        print_engine(*fix);
    } else if (const Trial* untimed = table.untimed_fix()) {
        fmt::print("no fix is known yet: {} is one if it costs no more time than the shadow does\n      {}\n",
                   untimed->candidate.shown_name(), set_options_text(untimed->changes));
    } else {
        fmt::print("no fix: none of {} changes that were tried {} and makes nothing worse\n", table.drawn(),
                   table.rows.front().pixel ? "makes this pixel right" : "lowers the error");
    }
    if (table.refused > 0) fmt::print("{}\n", refused_text(table.refused, engine));
    if (table.stopped) fmt::print("stopped: {} of {} changes were tried\n", table.drawn(), table.candidates);
    if (std::ranges::any_of(table.rows, &Trial::helps) && rows > 0)
        fmt::print(
            "changes that help, each drawn and measured ({} pixels are wrong now):\n  {:>8} {:>8} {:>10} {:>10} "
            "{:>9}\n",
            table.wrong, "cured", "broken", "error", "time", "map");
    for (const Trial& t : table.rows) {
        if (!t.is_drawn()) {
            fmt::print("  {:>49}  {}: not tried, {}\n", "", t.candidate.shown_name(), t.candidate.untried);
            continue;
        }
        if (rows == 0 || !t.helps()) continue;
        --rows;
        fmt::print("  {:>8} {:>8} {:>+10.3g} {:>10} {:>9}  {}{}\n      {}\n", t.cured, t.broken, t.added_error(),
                   time_text(t.ms), map_bytes_text(t.map_bytes()), t.candidate.shown_name(),
                   t.why_not.empty() ? "" : ": " + t.why_not, set_options_text(t.changes));
        print_engine(t);
    }
}

}  // namespace si
