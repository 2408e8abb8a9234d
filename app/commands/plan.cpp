#include <fmt/format.h>

#include "app/base/notes.h"
#include "app/commands/commands.h"
#include "app/commands/interruptible.h"
#include "app/context/headless_context.h"
#include "app/report/effects_json.h"
#include "app/report/health_report.h"
#include "app/report/report.h"
#include "renderer/base/lengths_text.h"
#include "renderer/render/reference_frames.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

bool shows_reference(const Settings& s) {
    return any_pane_shows(s.view, &Overlay::reads_reference);
}

/// Traces the references that the frame needs, and returns the row of the plan for their rays.
Effect trace_for(const Session& session, FrameRequest& request, const Workers& workers) {
    Effect effect{.name = "rays of the reference"};
    const bool sources = any_source_needs(session.settings, &SourceNeeds::reference) ||
                         any_source_needs(session.settings, &SourceNeeds::light_map);
    if (!sources && !shows_reference(session.settings)) {
        effect.reason = "No light's source needs rays, and no overlay shows the reference.";
        return effect;
    }
    Renderer renderer;  // a new one: nothing is cached, so that the plan shows a first frame
    ReferenceCache cache;
    if (shows_reference(session.settings))
        render_with_reference(renderer, session.scene, session.settings, request, cache, workers);
    else
        trace_sources(renderer, session.scene, session.settings, request, cache, workers);
    effect.state = EffectState::Drawn;
    effect.reason = sources ? "A light's source is traced or baked, before the frame."
                            : "An overlay shows the reference: its rays are traced before the frame.";
    return effect;
}

struct Planned {
    std::vector<Effect> effects;
    std::optional<SavedTimes> saved;
    std::optional<Waste> waste;
    std::vector<std::string> notes;
    std::shared_ptr<const NumericHealth> health;
};

Planned plan_of(const Session& session, const PlanOptions& options, Renderer& renderer, const Workers& workers,
                const auto& report) {
    Planned plan;
    FrameRequest request{.width = options.size.width, .height = options.size.height};
    Effect rays = trace_for(session, request, workers);
    request.outputs.health = options.check_numeric;
    const FrameResult frame = renderer.render(session.scene, session.settings, request);
    plan.effects.push_back(posing_effect(session.scene, session.settings.scene, true));
    plan.effects.push_back(std::move(rays));
    for (Effect& effect : frame_effects(session.scene, session.settings, frame))
        plan.effects.push_back(std::move(effect));
    plan.notes = frame.notes;
    if (options.check_numeric) plan.health = renderer.numeric_health(frame);
    if (options.measure)
        plan.saved =
            measure_saved_times(renderer, session.scene, session.settings, request, optimisations_of(plan.effects),
                                options.rounds, workers, [&](double share) { report(share, "alternating frames"); });
    request.outputs.health = false;  // the search reads whole maps, so that no part could be skipped
    request.timing = options.measure;
    ReferenceCache cache;
    if (options.waste)
        plan.waste = find_waste({renderer, session.scene, request.width, request.height, cache, workers, report},
                                session.settings, request);
    return plan;
}

/// Formats a difference of times with its interval: "4.1 ms (3.9 to 4.4)".
std::string difference_text(const Spread& ms) {
    return fmt::format("{:.2f} ms ({:.2f} to {:.2f})", ms.median, ms.median_low, ms.median_high);
}

Json plan_json(const Session& session, const PlanOptions& options, const Planned& plan, const DriverInfo& driver) {
    const SavedTimes* saved = plan.saved ? &*plan.saved : nullptr;
    Json json = {{"format", "shadow-inspector-plan"}, {"version", 1},
                 {"scene", session.scene_name},       {"width", options.size.width},
                 {"height", options.size.height},     {"measured", saved != nullptr}};
    json["effects"] = effects_json(plan.effects, saved);
    json["savings"] = optimisations_json(saved);
    json["frame_ms"] = saved ? Json(saved->frame.total_ms.median) : Json();
    const auto put = [&](const std::string& name, const std::optional<Spread>& ms) {
        json[name] = ms ? Json(ms->median) : Json();
        json[name + "_low"] = ms ? Json(ms->median_low) : Json();
        json[name + "_high"] = ms ? Json(ms->median_high) : Json();
    };
    put("shadow_ms", saved ? saved->shadow_ms : std::nullopt);
    put("forced_more_ms", saved ? saved->forced_more_ms : std::nullopt);
    json["rounds"] = saved ? Json(saved->rounds) : Json();
    json["clock"] = saved ? Json(saved->frame.clock) : Json();
    json["waste"] = plan.waste ? waste_json(*plan.waste) : Json();
    json["memory"] = memory_json(memory_report());
    json["driver"] = driver_json(driver);
    return json;
}

}  // namespace

void run_plan(const PlanOptions& options) {
    const Session session = open_session(options.session);
    const HeadlessContext context;
    Renderer renderer;
    const Planned plan = interruptible("nothing was printed", [&](Workers workers, const auto& report) {
        workers.progress = [&](double share) { report(share, "rays"); };
        return plan_of(session, options, renderer, workers, report);
    });
    if (options.json) {
        fmt::print("{}", json_text(plan_json(session, options, plan, renderer.driver())));
    } else {
        print_effects(plan.effects, plan.saved ? &*plan.saved : nullptr);
        if (plan.saved && plan.saved->shadow_ms && plan.saved->forced_more_ms)
            fmt::print("\nshadow: {} of the frame; with every effect forced the frame costs {} more\n",
                       difference_text(*plan.saved->shadow_ms), difference_text(*plan.saved->forced_more_ms));
        if (plan.saved)
            fmt::print(
                "\n{} {} a frame with all its passes; medians of {} alternating rounds, with their 95 % "
                "intervals; {}\n",
                digits_text(plan.saved->frame.total_ms.median), time_unit(plan.saved->frame.clock), plan.saved->rounds,
                plan.saved->frame.clock);
        if (plan.waste) print_waste(*plan.waste);
    }
    print_notes(session.notes);
    print_notes(plan.notes);
    if (plan.health) require_sound(*plan.health);
    end_if_interrupted("not everything was tried");
}

}  // namespace si
