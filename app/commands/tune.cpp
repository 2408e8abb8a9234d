#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/base/json_text.h"
#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/fixes_json.h"
#include "app/report/health_report.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "app/session/engine_session.h"
#include "app/session/setting_json.h"
#include "renderer/advise/tuning.h"
#include "renderer/base/error.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

Json bias_json(const BiasSettings& b) {
    Settings with;
    with.bias = b;
    Json json = {{"kind", bias_of(with).key}};
    static constexpr const char* kUnits[] = {"depth", "texels", "metres"};
    json["unit"] = kUnits[std::size_t(b.unit)];
    for (const auto& [name, value] : {std::pair("constant", b.constant),
                                      {"slope", b.slope},
                                      {"normal", b.normal},
                                      {"raster_slope", b.raster_slope},
                                      {"raster_units", b.raster_units}})
        json[name] = value;
    return json;
}

Json trial_json(const BiasTrial& t) {
    return {{"score", t.score},
            {"acne_px", t.acne()},
            {"faint_px", t.needs.faint_acne},
            {"corner_px", t.needs.folds},
            {"lost_px", t.lost()},
            {"leak_px", t.error.artefacts[std::size_t(Artefact::Leak)]},
            {"wrong_px", wrong_pixels(t.error)},
            {"gap_median_m", t.needs.gap_median_m},
            {"gap_p95_m", t.needs.gap_p95_m},
            {"shift_p95_m", t.needs.shift_p95_m},
            {"error", error_json(t.error)}};
}

Json tuned_json(const Tuned& tuned, const TuneGoals& goals, const Settings& before, const Settings& after,
                double seconds) {
    const auto rows = [](const std::vector<const TriedBias*>& list, const TriedBias* chosen) {
        return json_list(list, [&](const TriedBias* p) {
            const TriedBias& t = *p;
            Json row = {{"row", t.row->key},
                        {"chosen", p == chosen},
                        {"no_acne", t.trial.has_no_acne()},
                        {"of_theory", t.strength},
                        {"bias", bias_json(t.bias)}};
            row.update(trial_json(t.trial));
            return row;
        });
    };
    const auto case_json = [&](const AutopilotCase& c) -> Json {
        return {{"kernel", kernel_label(c.settings)},
                {"resolution", c.settings.map.resolution},
                {"chosen", tuned.limits->goals_met && c.axis_values == tuned.limits->best.axis_values},
                {"within_limits", c.holds ? Json(*c.holds) : Json()},
                {"error", c.classified.error},
                {"ms", c.ms ? Json(*c.ms) : Json()},
                {"bias", bias_json(c.settings.bias)}};
    };
    Json json = {{"format", "shadow-inspector-tuning"},
                 {"version", 2},
                 {"found", tuned.result.has_value()},
                 {"summary", tuned.summary},
                 {"timed", cost_row(goals.cost).key},
                 {"trials", tuned.bias.tried.size()},
                 {"stopped", tuned.bias.stopped || (tuned.limits && tuned.limits->stopped)},
                 {"seconds", seconds},
                 {"before", trial_json(tuned.bias.before)},
                 {"lit_pixels", tuned.bias.before.needs.pixels},
                 {"biases", rows(tuned.bias.best_of_rows(), tuned.bias.best())},
                 {"without_acne", rows(tuned.bias.best_of_rows(true), tuned.bias.best_without_acne())},
                 {"candidates", tuned.limits ? json_list(tuned.limits->cases, case_json) : Json::array()},
                 {"settings", Json::object()}};
    for (const SettingRef& ref : all_settings(after))
        if (get_value(after, ref) != get_value(before, ref))
            json["settings"][setting_key(ref)] = setting_to_json(ref, get_value(after, ref));
    return json;
}

void print_tuned(const Tuned& tuned) {
    const FoundBias& found = tuned.bias;
    if (!found.tried.empty())
        fmt::print("  {:<28} {:>9} {:>9} {:>9} {:>11} {:>11}\n", "tried", "score", "wrong px", "acne px", "gap",
                   "edge shift");
    const auto print_row = [](const TriedBias& t, const char* note) {
        fmt::print("  {:<28} {:>9.1f} {:>9} {:>9} {:>11} {:>11}  {}{}\n", t.row->label, t.trial.score,
                   wrong_pixels(t.trial.error), t.trial.acne(), metres_text(t.trial.needs.gap_p95_m),
                   metres_text(t.trial.needs.shift_p95_m), bias_text(t.bias), note);
    };
    for (const TriedBias* t : found.best_of_rows()) print_row(*t, t == found.best() ? "  chosen" : "");
    if (const TriedBias* clean = found.best_without_acne()) print_row(*clean, "  chosen without acne");
    if (!tuned.limits) return;
    for (const AutopilotCase& c : tuned.limits->cases)
        if (c.ms)
            fmt::print("  {:<14} {:>5}²  error {:>8.5f}  {:>9}  {}\n", kernel_label(c.settings),
                       c.settings.map.resolution, c.classified.error, digits_text(*c.ms) + " ms",
                       tuned.limits->goals_met && c.axis_values == tuned.limits->best.axis_values ? "chosen"
                       : !c.holds ? "undecided within noise"
                       : *c.holds ? "within the limits"
                                  : "outside the limits");
}

/// Returns the numbers of an engine's bias for settings and the map that they give.
Json engine_numbers_json(const EngineProfile& profile, const Settings& settings, const MapFacts& facts) {
    const WrittenValues written = write_engine_values(profile, settings, facts);
    Json numbers = Json::object();
    for (const ConvertedParameter& p : written.parameters) {
        if (!p.parameter->is_bias) continue;
        Json number = written_parameter_json(p);
        number["note"] = p.note;
        numbers[std::string(p.parameter->key)] = std::move(number);
    }
    return {{"profile", profile.name},
            {"unverified", profile.unverified},
            {"width_m", facts.width_m},
            {"texels", facts.texels},
            {"depth_m", facts.depth_m},
            {"angle_deg", facts.angle_deg},
            {"hidden_texels", written.hidden_texels},
            {"parameters", numbers}};
}

/// Prints the numbers of an engine's bias for settings and the map that they give.
void print_engine_numbers(const EngineProfile& profile, const Settings& settings, const MapFacts& facts) {
    fmt::print("in {}, for a map of {:.4g} m, {} texels and {:.4g} m of depth, at {:g} degrees:\n", profile.title,
               facts.width_m, facts.texels, facts.depth_m, facts.angle_deg);
    for (const ConvertedParameter& p : write_engine_values(profile, settings, facts).parameters)
        if (p.parameter->is_bias)
            fmt::print("  {} = {:.6g} {} ({:.3g} texels, {:.3g} m{}{})\n", p.parameter->key, p.value, p.parameter->unit,
                       p.texels, p.metres, p.exactness == Exactness::Exact ? "" : "; at this angle only",
                       p.note.empty() ? "" : "; " + p.note);
}

}  // namespace

std::vector<std::string_view> tuned_errors() {
    std::vector<std::string_view> names;
    for (const Metric& m : metrics())
        if (m.better != Better::Neither) names.push_back(m.key);
    return names;
}

const Metric& tuned_error(const std::string& key) {
    const std::vector<std::string_view> names = tuned_errors();
    if (key.empty()) return *find_metric(names.front());
    if (std::find(names.begin(), names.end(), key) != names.end()) return *find_metric(key);
    throw UsageError(fmt::format("--error {}: it is one of {}", key, fmt::join(names, ", ")));
}

void run_tune(const TuneOptions& options) {
    require_output(options.output, "a preset", {".json"});
    const TuneGoals goals{.max_error = options.max_error,
                          .max_ms = options.max_ms,
                          .error = &tuned_error(options.error),
                          .cost = options.cost,
                          .no_acne = options.no_acne,
                          .max_gap_m = options.max_gap};
    Session session = open_session(options.session);
    const EngineWording& engine = session.engine;
    const HeadlessContext context;
    Renderer renderer;
    ReferenceCache cache;
    const NumberWatch numbers(renderer, session.settings, options.check_numeric);
    const auto began = std::chrono::steady_clock::now();
    const Tuned tuned =
        interruptible(options.output + " was not written", [&](const Workers& workers, const auto& report) {
            return tune({renderer, session.scene, options.size.width, options.size.height, cache, workers, report,
                         engine.profile},
                        session.settings, goals);
        });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    Settings after = session.settings;
    if (tuned.result) apply_tuning(after, *tuned.result);
    MapFacts facts;
    if (engine.profile) {
        // Resolution and normal offset have changed, and the map with them.
        facts = map_facts(session.scene, after);
        facts.angle_deg = engine.facts.angle_deg;
    }
    const std::string clock = goals.any() ? renderer.driver().clock : std::string();
    if (options.json) {
        Json json = tuned_json(tuned, goals, session.settings, after, seconds);
        if (engine.profile) json["engine"] = engine_numbers_json(*engine.profile, after, facts);
        json["clock"] = clock.empty() ? Json() : Json(clock);
        fmt::print("{}", json_text(json));
    } else {
        print_tuned(tuned);
        fmt::print("{}\n", tuned.summary);
        if (tuned.result && engine.profile) print_engine_numbers(*engine.profile, after, facts);
        if (!clock.empty()) fmt::print("times by {}\n", clock);
    }
    // A picture without lit pixels needs no bias, so that there is nothing to find.
    const bool nothing_lit = tuned.bias.before.needs.pixels == 0 && !goals.any();
    if (!tuned.result && !nothing_lit) {
        numbers.require_sound();
        end_if_interrupted("nothing was written");
        throw Error(tuned.summary + "; nothing was written");
    }
    save_preset({"", "", tuned.summary, scene_for_preset(session.scene_name, options.output), after}, options.output);
    if (!options.json) print_wrote(options.output);
    print_notes(session.notes);
    numbers.require_sound();
    end_if_interrupted("not everything was tried");
}

}  // namespace si
