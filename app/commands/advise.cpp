#include <fmt/format.h>

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
#include "renderer/advise/autopilot.h"
#include "renderer/base/command_text.h"
#include "renderer/base/error.h"
#include "renderer/base/lengths_text.h"

namespace si {
namespace {

Json advice_json(const Trial& t, const EngineWording& engine) {
    static constexpr const char* kClaims[] = {"same", "right", "trade"};
    Json json = {{"rule", t.candidate.rule.empty() ? "fix" : t.candidate.rule},
                 {"claim", kClaims[std::size_t(t.candidate.claim)]},
                 {"text", t.candidate.shown_name()},
                 {"light", t.candidate.light},
                 {"settings", changes_json(t.changes)},
                 {"holds", t.why_not.empty()},
                 {"why_not", t.why_not.empty() ? Json() : Json(t.why_not)},
                 {"error", {{"before", t.before.error}, {"after", t.after.error}, {"tolerance", t.tolerance()}}},
                 {"ms", t.ms ? change_json(*t.ms) : Json()},
                 {"cost", {{"before", cost_json(t.before.work)}, {"after", cost_json(t.after.work)}}}};
    if (engine.profile) json["engine"] = engine_changes_json(engine, t.changes);
    return json;
}

Json finding_json(const Finding& f, const EngineWording& engine) {
    Json json = {{"severity", severity_key(f.severity)},
                 {"text", f.text},
                 {"cure", f.fix.empty() ? Json() : Json(f.fix)},
                 {"settings", changes_json(f.settings)}};
    if (engine.profile) json["engine"] = engine_changes_json(engine, f.settings);
    return json;
}

Json head_json(const char* format, const AdviseOptions& o, const Metric& error) {
    return {{"format", format},
            {"version", 1},
            {"width", o.size.width},
            {"height", o.size.height},
            {"timed", cost_row(o.cost).key},
            {"metric", error.key}};
}

Json report_json(const AdviceReport& r, const AdviseOptions& o, const EngineWording& engine) {
    Json json = head_json("shadow-inspector-advice", o, *r.options.error);
    json["error"] = r.before.error;
    json["time"] = time_json(r.time);
    json["cost"] = cost_json(r.before.work);
    const auto advice = [&](const Trial& t) { return advice_json(t, engine); };
    json["advice"] = json_list(r.holds, advice);
    json["tried"] = json_list(r.fails, advice);
    json["findings"] = json_list(r.findings, [&](const Finding& f) { return finding_json(f, engine); });
    json["refused"] = r.refused;
    json["stopped"] = r.stopped;
    return json;
}

/// @param clock name of the clock of all times
Json autopilot_json(const AutopilotResult& r, const AdviseOptions& o, const Metric& error, const std::string& clock) {
    Json json = head_json("shadow-inspector-autopilot", o, error);
    json["held"] = r.goals_met;
    json["summary"] = r.summary;
    json["clock"] = clock;
    json["before"] = {{"error", r.before.error}, {"ms", r.before_ms}};
    json["best"] = {{"error", r.best.classified.error},
                    {"ms", r.best.ms ? Json(*r.best.ms) : Json()},
                    {"cost", cost_json(r.best.classified.work)},
                    {"settings", changes_json(r.best.changes)}};
    json["combinations"] = r.combinations;
    json["seconds"] = r.seconds;
    json["stopped"] = r.stopped;
    json["untried"] = r.untried;
    json["dropped"] = json_list(r.dropped, [](const SettingContribution& d) -> Json {
        return {{"setting", d.key},
                {"was", d.before},
                {"is", d.now},
                {"error_with", d.error},
                {"ms_more", change_json(d.ms)}};
    });
    json["cases"] = json_list(r.cases, [](const AutopilotCase& c) -> Json {
        return {{"settings", changes_json(c.changes)},
                {"error", c.classified.error},
                {"ms", c.ms ? Json(*c.ms) : Json()},
                {"holds", c.holds ? Json(*c.holds) : Json()}};
    });
    return json;
}

/// Prints changes of settings as an engine's parameters, if some of its bias change.
void print_engine_changes(const EngineWording& engine, const SettingChanges& changes) {
    if (const std::string text = engine.text(changes); !text.empty()) fmt::print("      {}\n", text);
}

void print_advice(const Trial& t, const EngineWording& engine) {
    fmt::print("  {:>10} {:>+11.3g}  {}{}\n      {}\n", time_text(t.ms), t.added_error(), t.candidate.shown_name(),
               t.why_not.empty() ? "" : ": " + t.why_not, set_options_text(t.changes));
    print_engine_changes(engine, t.changes);
}

void print_report(const AdviceReport& r, const EngineWording& engine) {
    const CostRow& cost = cost_row(r.options.cost);
    fmt::print("now {} {:.5g}, {} {} a frame {}\n", r.options.error->key, r.before.error,
               digits_text(r.time.total_ms.median), time_unit(r.time.clock), cost.when);
    for (const Finding& f : r.findings) {
        fmt::print("{}: {}{}{}{}\n", severity_key(f.severity), f.text, f.fix.empty() ? "" : "; ", f.fix,
                   f.settings.empty() ? "" : "\n      " + set_options_text(f.settings));
        print_engine_changes(engine, f.settings);
    }
    if (r.holds.empty()) fmt::print("nothing that was tried is better\n");
    if (!r.holds.empty() || !r.fails.empty()) fmt::print("  {:>10} {:>11}\n", "time", "error");
    for (const Trial& t : r.holds) print_advice(t, engine);
    if (r.refused > 0) fmt::print("{}\n", refused_text(r.refused, engine));
    if (r.stopped) fmt::print("stopped before all changes were tried\n");
    if (!r.fails.empty()) fmt::print("tried, does not hold:\n");
    for (const Trial& t : r.fails) print_advice(t, engine);
}

/// @param clock name of the clock of all times
void print_flight(const AutopilotResult& r, const std::string& clock) {
    for (const SettingContribution& d : r.dropped)
        fmt::print("  {}={} instead of {}: {} would have cost {} (error {:.4g} with it)\n", d.key, d.now, d.before,
                   d.before, time_text(d.ms), d.error);
    for (const std::string& text : r.untried) fmt::print("  {}\n", text);
    fmt::print("{} of {} combinations in {:.0f} s\n{}\ntimes by {}\n", r.cases.size(), r.combinations, r.seconds,
               r.summary, clock);
}

class Advisor {
public:
    explicit Advisor(const AdviseOptions& options) : o_(options), session_(open_session(options.session)) {}

    void advise(const Metric& error) {
        const AdviceReport r = interruptible("nothing was written", [&](const Workers& workers, const auto& report) {
            return find_advice(tools(workers, report), session_.settings, {.error = &error, .cost = o_.cost});
        });
        if (o_.json)
            fmt::print("{}", json_text(report_json(r, o_, session_.engine)));
        else
            print_report(r, session_.engine);
        print_notes(session_.notes);
        numbers_.require_sound();
        end_if_interrupted("not everything was tried");
    }

    void run_autopilot(const Metric& error) {
        std::vector<SweepAxis> axes;
        for (const std::string& axis : o_.vary) axes.push_back(parse_axis(axis));
        const AutopilotGoals goals{.max_error = o_.max_error,
                                   .max_ms = o_.max_ms,
                                   .error = &error,
                                   .cost = o_.cost,
                                   .max_seconds = o_.max_seconds};
        const AutopilotResult r = interruptible("nothing was written", [&](const Workers& workers, const auto& report) {
            return run_rendered_autopilot(tools(workers, report), session_.settings, goals, axes);
        });
        if (o_.json)
            fmt::print("{}", json_text(autopilot_json(r, o_, error, renderer_.driver().clock)));
        else
            print_flight(r, renderer_.driver().clock);
        if (!r.goals_met) {
            numbers_.require_sound();
            end_if_interrupted("nothing was written");
            throw Error(r.summary + (o_.output.empty() ? "" : "; nothing was written"));
        }
        if (!o_.output.empty()) write(r);
        print_notes(session_.notes);
        numbers_.require_sound();
        end_if_interrupted("not everything was tried");
    }

private:
    const AdviseOptions& o_;
    Session session_;
    HeadlessContext context_;
    Renderer renderer_;
    NumberWatch numbers_{renderer_, session_.settings, o_.check_numeric};
    ReferenceCache cache_;

    SearchTools tools(const Workers& workers, const auto& report) {
        return {renderer_, session_.scene, o_.size.width, o_.size.height,
                cache_,    workers,        report,        session_.engine.profile};
    }
    void write(const AutopilotResult& r) const {
        Settings after = session_.settings;
        set_settings(after, r.best.changes);
        save_preset({"", "", r.summary, scene_for_preset(session_.scene_name, o_.output), after}, o_.output);
        if (!o_.json) print_wrote(o_.output);
    }
};

}  // namespace

void run_advise(const AdviseOptions& options) {
    const bool flies = options.max_error || options.max_ms;
    if (!flies && !(options.output.empty() && options.vary.empty()))
        throw UsageError("--output and --vary belong to the autopilot; add --max-error or --max-ms");
    if (!options.output.empty()) require_output(options.output, "a preset", {".json"});
    const Metric& error = tuned_error(options.error);
    Advisor advisor(options);
    if (flies)
        advisor.run_autopilot(error);
    else
        advisor.advise(error);
}

}  // namespace si
