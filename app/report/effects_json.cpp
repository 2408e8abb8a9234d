#include "app/report/effects_json.h"

#include <fmt/format.h>

#include <algorithm>

namespace si {
namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

Json effects_json(std::span<const Effect> effects, const SavedTimes* saved) {
    Json rows = Json::array();
    for (const Effect& effect : effects) {
        Json row = {{"name", effect.name}, {"state", state_name(effect.state)}, {"reason", effect.reason}};
        put_saved(row, saved ? saved->of(effect) : nullptr);
        row["saving"] = effect.saving ? Json(row_of(*effect.saving).key) : Json();
        row["pass"] = effect.pass.empty() ? Json() : Json(effect.pass);
        row["part"] = effect.part;
        const Spread* ms = time_of_pass(effect, saved);
        row["ms"] = ms ? Json(ms->median) : Json();
        rows.push_back(std::move(row));
    }
    return rows;
}

Json savings_json(const SavedTimes* saved) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < kSavings; ++i) {
        const SavingRow& saving = savings()[i];
        Json row = {{"key", saving.key}, {"label", saving.label}, {"help", saving.help}};
        put_saved(row, saved ? saved->of(Saving(i)) : nullptr);
        rows.push_back(std::move(row));
    }
    return rows;
}

Json waste_json(const Waste& waste) {
    Json rows = Json::array();
    for (const Tried& t : waste.tried)
        rows.push_back({{"name", t.name},
                        {"changes_picture", t.changes},
                        {"texels_read", t.read < 0 ? Json() : Json(t.read)},
                        {"triangles", t.triangles}});
    return {{"tried", std::move(rows)},
            {"triangles", waste.triangles()},
            {"wasted_triangles", waste.wasted()},
            {"share", waste.share()}};
}

std::string saved_text(const Spread* ms) {
    if (!ms) return "–";
    return fmt::format("{:.2f} ({:.2f} to {:.2f})", ms->median, ms->median_low, ms->median_high);
}

void print_effects(std::span<const Effect> effects, const SavedTimes* saved) {
    std::size_t wide = 0;
    for (const Effect& effect : effects) wide = std::max(wide, effect.name.size() + (effect.part ? 2 : 0));
    fmt::print("{:<14} {:>10} {:>22}  {:<{}}  {}\n", "state", "ms", "saved ms", "effect", wide, "why");
    for (const Effect& effect : effects) {
        const Spread* ms = time_of_pass(effect, saved);
        fmt::print("{:<14} {:>10} {:>22}  {:<{}}  {}\n", state_name(effect.state),
                   ms ? fmt::format("{:.2f}", ms->median) : "–", saved_text(saved ? saved->of(effect) : nullptr),
                   fmt::format("{}{}", effect.part ? "  " : "", effect.name), wide, effect.reason);
    }
}

void print_waste(const Waste& waste) {
    fmt::print("\nleft out in turn; what changes no byte of the picture is waste:\n");
    for (const Tried& t : waste.tried) {
        const std::string read = t.read < 0 ? "" : fmt::format(", {:.2f} % of its texels are read", 100 * t.read);
        const bool undrawn = t.read >= 0 && t.triangles == 0 && !t.changes;
        fmt::print("  {:<9} {:>10} triangles  {}{}\n",
                   t.changes ? "needed"
                   : undrawn ? "not drawn"
                             : "waste",
                   t.triangles, t.name, read);
    }
    if (waste.tried.empty()) fmt::print("  there is nothing to leave out\n");
    fmt::print("{} of {} triangles drawn into maps are waste ({:.1f} %)\n", waste.wasted(), waste.triangles(),
               100 * waste.share());
}

}  // namespace si
