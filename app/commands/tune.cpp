#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "app/base/json_text.h"
#include "app/base/notes.h"
#include "app/base/output.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/health_report.h"
#include "app/report/measure_json.h"
#include "app/report/report.h"
#include "app/session/setting_json.h"
#include "app/sweep/tuning.h"
#include "renderer/base/error.h"
#include "renderer/base/lengths_text.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

Json bias_json(const BiasSettings& b) {
    static constexpr const char* kUnits[] = {"depth", "texels", "metres"};
    return {{"unit", kUnits[std::size_t(b.unit)]}, {"constant", b.constant}, {"slope", b.slope}, {"normal", b.normal}};
}

Json trial_json(const BiasTrial& t) {
    return {{"acne_px", t.acne()},
            {"corner_px", t.needs.folds},
            {"lost_px", t.lost()},
            {"leak_px", t.error.artefacts[std::size_t(Artefact::Leak)]},
            {"wrong_px", t.wrong()},
            {"gap_median_m", t.needs.gap_median_m},
            {"gap_p95_m", t.needs.gap_p95_m},
            {"shift_p95_m", t.needs.shift_p95_m},
            {"error", error_json(t.error)}};
}

Json tuned_json(const Tuner& tuner, const Settings& before, const Settings& after, CostCase cost, double seconds) {
    const BiasSearch& search = tuner.bias();
    const auto family = [&](const BiasFound& f) {
        Json row = {{"family", family_label(f.family)},
                    {"chosen", search.best() && search.best()->family == f.family},
                    {"no_acne", f.trial.acne() == 0},
                    {"of_theory", f.factor},
                    {"bias", bias_json(f.bias)}};
        row.update(trial_json(f.trial));
        return row;
    };
    const auto candidate = [&](const TuneCandidate& c) -> Json {
        return {{"kernel", c.kernel},
                {"resolution", c.settings.map.resolution},
                {"chosen", &c == tuner.best()},
                {"within_limits", c.meets},
                {"no_acne", c.clear},
                {"error", c.trial ? Json(c.error) : Json()},
                {"ms", c.ms ? Json(*c.ms) : Json()},
                {"bias", bias_json(c.settings.bias)}};
    };
    Json json = {{"format", "shadow-inspector-tuning"},
                 {"version", 1},
                 {"found", tuner.result().has_value()},
                 {"summary", tuner.summary()},
                 {"timed", cost_row(cost).key},
                 {"trials", tuner.trials()},
                 {"seconds", seconds},
                 {"before", trial_json(search.before())},
                 {"lit_pixels", search.before().needs.pixels},
                 {"families", json_list(search.tried(), family)},
                 {"candidates", json_list(tuner.candidates(), candidate)},
                 {"settings", Json::object()}};
    for (const SettingRef& ref : all_settings(after))
        if (get_value(after, ref) != get_value(before, ref))
            json["settings"][setting_key(ref)] = setting_to_json(ref, get_value(after, ref));
    return json;
}

void print_tuned(const Tuner& tuner) {
    const BiasSearch& search = tuner.bias();
    if (!search.tried().empty())
        fmt::print("  {:<14} {:>9} {:>9} {:>9} {:>11} {:>11}\n", "tried", "wrong px", "lost px", "acne px", "strip",
                   "edge shift");
    for (const BiasFound& f : search.tried())
        fmt::print("  {:<14} {:>9} {:>9} {:>9} {:>11} {:>11}  {}{}\n", family_label(f.family), f.trial.wrong(),
                   f.trial.lost(), f.trial.acne(), metres_text(f.trial.needs.gap_p95_m),
                   metres_text(f.trial.needs.shift_p95_m), bias_text(f.bias),
                   search.best() && search.best()->family == f.family ? "  chosen" : "");
    for (const TuneCandidate& c : tuner.candidates()) {
        const std::string error = c.trial ? fmt::format("{:.5f}", c.error) : "-";
        const std::string ms = c.ms ? digits_text(*c.ms) + " ms" : "-";
        fmt::print("  {:<14} {:>5}²  error {:>8}  {:>9}  {}\n", c.kernel, c.settings.map.resolution, error, ms,
                   &c == tuner.best()    ? "chosen"
                   : c.meets             ? "within the limits"
                   : c.trial && !c.clear ? "acne remains"
                                         : "");
    }
    fmt::print("{}\n", tuner.summary());
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
                          .cost = options.cost};
    Session session = open_session(options.session);
    const HeadlessContext context;
    Renderer renderer;
    const NumberWatch numbers(renderer, session.settings, options.check_numeric);
    const TuningJob job{session.settings, options.size.width, options.size.height, goals};
    const auto began = std::chrono::steady_clock::now();
    const Tuner tuner =
        interruptible(options.output + " was not written", [&](const Workers& workers, const auto& report) {
            return run_tuning(renderer, session.scene, job, workers,
                              [&](const Tuner& t) { report(t.progress(), t.step_label()); });
        });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    const std::optional<Settings> found = tuner.result();
    Settings after = session.settings;
    if (found) apply_tuning(after, *found);
    const std::string clock = goals.max_error || goals.max_ms ? renderer.driver().clock : std::string();
    if (options.json) {
        Json json = tuned_json(tuner, session.settings, after, goals.cost, seconds);
        json["clock"] = clock.empty() ? Json() : Json(clock);
        fmt::print("{}", json_text(json));
    } else {
        print_tuned(tuner);
        if (!clock.empty()) fmt::print("times by {}\n", clock);
    }
    if (!found) numbers.require_sound();
    if (!found) throw Error(tuner.summary() + "; nothing was written");
    save_preset({"", "", tuner.summary(), session.scene_name, after}, options.output);
    if (!options.json) print_wrote(options.output);
    print_notes(session.notes);
    numbers.require_sound();
}

}  // namespace si
