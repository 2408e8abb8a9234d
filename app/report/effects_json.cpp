#include "app/report/effects_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "renderer/optimisations/optimisations.h"

namespace si {
namespace {

void put_saved(Json& json, const Spread* ms) {
    json["saved_ms"] = ms ? Json(ms->median) : Json();
    json["saved_ms_low"] = ms ? Json(ms->median_low) : Json();
    json["saved_ms_high"] = ms ? Json(ms->median_high) : Json();
}

const Spread* time_of_pass(const Effect& effect, const SavedTimes* saved) {
    if (!saved || effect.part) return nullptr;
    for (const PassTime& pass : saved->frame.passes)
        if (pass.name == effect.pass) return &pass.gpu_ms;
    return nullptr;
}

/// Formats the time that an optimisation saves, in ms: "1.20 (0.90 to 1.50), of 3 together"; a dash for null.
/// @param together number of effects that were forced together for this time
std::string saved_time_text(const Spread* ms, std::size_t together) {
    if (!ms) return "–";
    return fmt::format("{:.2f} ({:.2f} to {:.2f}){}", ms->median, ms->median_low, ms->median_high,
                       together > 1 ? fmt::format(", of {} together", together) : "");
}

}  // namespace

Json effects_json(std::span<const Effect> effects, const SavedTimes* saved) {
    return json_list(effects, [&](const Effect& effect) {
        Json row = {{"name", effect.name}, {"state", effect_state_key(effect.state)}, {"reason", effect.reason}};
        const Spread* saved_ms = saved ? saved->saved_ms(effect) : nullptr;
        put_saved(row, saved_ms);
        row["saved_together"] = saved_ms ? Json(sharing_optimisation_count(effects, effect)) : Json();
        row["saving"] = effect.optimisation ? Json(row_of(*effect.optimisation).key) : Json();
        row["pass"] = effect.pass.empty() ? Json() : Json(effect.pass);
        row["part"] = effect.part;
        const Spread* ms = time_of_pass(effect, saved);
        row["ms"] = ms ? Json(ms->median) : Json();
        return row;
    });
}

Json optimisations_json(const SavedTimes* saved) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < kOptimisations; ++i) {
        const OptimisationRow& saving = optimisation_rows()[i];
        Json row = {{"key", saving.key}, {"label", saving.label}, {"help", saving.help}};
        put_saved(row, saved ? saved->saved_ms(Optimisation(i)) : nullptr);
        rows.push_back(std::move(row));
    }
    return rows;
}

Json waste_json(const Waste& waste) {
    const auto trial = [&](const WasteTrial& t) -> Json {
        return {{"name", t.name},
                {"changes_picture", t.changes},
                {"texels_read", t.read < 0 ? Json() : Json(t.read)},
                {"triangles", t.triangles},
                {"maps_ms", waste.maps_ms && !t.changes ? Json(t.maps_ms) : Json()}};
    };
    const std::optional<double> of_time = waste.share_of_time();
    return {{"tried", json_list(waste.tried, trial)},
            {"triangles", waste.triangles()},
            {"wasted_triangles", waste.wasted()},
            {"share", waste.share()},
            {"maps_ms", waste.maps_ms ? Json(*waste.maps_ms) : Json()},
            {"wasted_ms", waste.maps_ms ? Json(waste.wasted_ms()) : Json()},
            {"share_of_time", of_time ? Json(*of_time) : Json()},
            {"stopped", waste.stopped}};
}

void print_effects(std::span<const Effect> effects, const SavedTimes* saved) {
    std::size_t wide = 0, saved_wide = 22;
    std::vector<std::string> saved_texts;
    for (const Effect& effect : effects) {
        wide = std::max(wide, effect.name.size() + (effect.part ? 2 : 0));
        saved_texts.push_back(
            saved_time_text(saved ? saved->saved_ms(effect) : nullptr, sharing_optimisation_count(effects, effect)));
        saved_wide = std::max(saved_wide, saved_texts.back().size());
    }
    fmt::print("{:<14} {:>10} {:>{}}  {:<{}}  {}\n", "state", "ms", "saved ms", saved_wide, "effect", wide, "why");
    for (std::size_t i = 0; i < effects.size(); ++i) {
        const Effect& effect = effects[i];
        const Spread* ms = time_of_pass(effect, saved);
        fmt::print("{:<14} {:>10} {:>{}}  {:<{}}  {}\n", effect_state_label(effect.state),
                   ms ? fmt::format("{:.2f}", ms->median) : "–", saved_texts[i], saved_wide,
                   fmt::format("{}{}", effect.part ? "  " : "", effect.name), wide, effect.reason);
    }
}

void print_waste(const Waste& waste) {
    fmt::print("\nleft out one at a time; work that changes no byte of the picture is waste:\n");
    for (const WasteTrial& t : waste.tried)
        fmt::print("  {:<9} {:>10} triangles  {}\n", t.verdict(), t.triangles, t.text());
    if (waste.tried.empty()) fmt::print("  there is nothing to leave out\n");
    if (waste.stopped) fmt::print("stopped before all work was left out once\n");
    fmt::print("{}", waste.summary());
}

}  // namespace si
