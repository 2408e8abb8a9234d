#include "app/editor/background_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "app/editor/requests.h"
#include "renderer/base/printable.h"
#include "renderer/inspect/effects.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/reference.h"
#include "ui/state/panels.h"

namespace si {
namespace {

Tuned search_bias(const SearchTools& t, Settings settings, const SearchRequest& request,
                  const std::function<void(Tuned)>& show) {
    const auto began = std::chrono::steady_clock::now();
    const TuneGoals goals{.max_error = request.max_error, .max_ms = request.max_ms, .cost = request.cost};
    settings.truth.area |= request.area;
    Tuned tuned = tune(t, settings, goals, [&](const FoundBias& found) { show({.bias = found}); });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    tuned.summary += fmt::format("; {} trials in {:.1f} s", tuned.bias.tried.size(), seconds);
    return tuned;
}

AdviceFound search_advice(const SearchTools& t, const Settings& settings, const SearchRequest& request,
                          const std::function<void(AdviceFound)>& show) {
    if (request.max_error || request.max_ms)
        return run_rendered_autopilot(t, settings,
                                      {.max_error = request.max_error, .max_ms = request.max_ms, .cost = request.cost},
                                      {}, [&](const AutopilotResult& so_far) { show(so_far); });
    return find_advice(t, settings, {.cost = request.cost}, show);
}

ShimmerFound search_shimmer(const SearchTools& t, const Settings& settings, const ShimmerOptions& options,
                            const std::function<void(ShimmerFound)>& show) {
    ShimmerFound out{{}, options};
    const std::vector<ShimmerVariant> variants = shimmer_variants(settings);
    for (const ShimmerVariant& v : variants) {
        const double before = double(out.variants.size()) / double(variants.size());
        const auto report = [&](double share) {
            t.report(before + share / double(variants.size()), std::string(v.label));
        };
        out.variants.push_back(
            {v.label, measure_shimmer(t.renderer, t.scene, v.settings, t.width, t.height, options, t.workers, report)});
        show(out);
    }
    return out;
}

LightPathResult search_light_path(const SearchTools& t, const Settings& settings, const LightPath& path,
                                  const std::function<void(LightPathResult)>& show) {
    return measure_light_path(t.renderer, t.scene, settings, t.width, t.height, path, {}, t.workers, t.report, show);
}

Waste search_waste(const SearchTools& t, const Settings& settings, FrameRequest unforced,
                   const std::function<void(Waste)>& show) {
    unforced.forced = {};
    unforced.timing = true;
    unforced.with_look = false;
    return find_waste(t, settings, unforced, show);
}

SavedTimes search_saved_times(const SearchTools& t, const Settings& settings, FrameRequest unforced,
                              const std::function<void(SavedTimes)>& show) {
    unforced.forced = {};  // a forced optimisation skips nothing that could be timed
    unforced.with_look = false;
    const FrameResult frame = t.renderer.render(t.scene, settings, unforced);
    const std::vector<Optimisation> named = optimisations_of(frame_effects(t.scene, settings, frame));
    return measure_saved_times(
        t.renderer, t.scene, settings, unforced, named, kSavedTimeRounds, t.workers,
        [&](double share) { t.report(share, "alternating frames"); }, show);
}

/// Returns the options of a search for fixes. The fix that the pixel's diagnosis suggests is tried, too.
FixOptions fix_options(const Settings& settings, std::span<const PixelDiagnosis> diagnoses, const FixRequest& request) {
    FixOptions options;
    options.pixel = request.pixel;
    options.first = request.first;
    options.list = request.pixel ? FixList::Whole : FixList::Short;
    const auto light = std::size_t(std::max(settings.view.light, 0));
    if (request.pixel && light < diagnoses.size())
        for (const auto& fix : {diagnoses[light].fix, diagnoses[light].fix_of_map})
            if (fix) options.more.push_back(suggested_candidate(*fix, settings));
    return options;
}

/// Returns true if a bias search of the present subject would give the same result. The present bias does not matter,
/// since the search replaces it.
bool is_current(SearchSubject of, const SearchSubject& present) {
    of.settings.bias = present.settings.bias;
    of.settings.truth.area = present.settings.truth.area;  // a search sets its own
    return of.searches_like(present);
}

}  // namespace

bool BackgroundWork::poll_found(auto& search) {
    const auto end = search.poll();
    if (end && !end->problem.empty()) state_.log.add(LogKind::Warning, end->problem);
    return end.has_value();
}

bool BackgroundWork::poll(const Scene* scene) {
    bool ended = poll_tuning(scene);
    const auto poll_each = [&](auto&... searches) { ((ended |= poll_found(searches)), ...); };
    poll_each(fixes_, pixel_fixes_, advice_, waste_, pipelines_, shimmer_, optimisation_times_, conversion_,
              light_path_);
    return ended;
}

bool BackgroundWork::poll_tuning(const Scene* scene) {
    const auto end = bias_search_.poll();
    if (!end) return false;
    if (end->failed) {
        report(state_, end->problem);
    } else if (!end->problem.empty()) {
        state_.log.add(LogKind::Info, end->problem);
    } else {
        const Tuned& found = *bias_search_.found();
        const SearchSubject& of = bias_search_.subject();
        // The result is valid for its scene, camera and light only.
        Settings now = state_.settings;
        apply_tuning(now, of.settings);
        const bool same = scene && scene->id == of.scene && measured_settings(now) == measured_settings(of.settings);
        if (found.result && !same) {
            state_.log.add(LogKind::Warning, "Not shown, as scene or settings changed meanwhile: " + found.summary);
            return true;
        }
        if (found.result) {
            Settings tried = state_.settings;
            apply_tuning(tried, *found.result);
            show_tried(state_, tried);
        }
        state_.log.add(LogKind::Info, found.summary);
    }
    return true;
}

void BackgroundWork::apply_sweep_base() {
    if (!sweep_.base()) return;
    const ViewSettings view = state_.settings.view;
    const int light = sweep_.base()->view.light;
    state_.settings = *sweep_.base();
    state_.settings.view = view;
    state_.settings.view.light = light;
}

bool BackgroundWork::fulfil(const SceneLoader& scenes, const FrameFacts& shown, const EditorRequests& requests) {
    bool changed = false;
    const auto request = [&](bool requested, const auto& what) {
        if (requested) changed |= attempt(state_, what);
    };
    // Starts a search about the present settings. @param requested argument of its work
    const auto start = [&](auto& search, const char* first, const auto& requested, const auto& work) {
        const Scene& scene = scenes.require();
        // A measurement needs a size, which a hidden picture does not have.
        const SearchSubject of{scene.id, state_.settings, shown.request.width, shown.request.height,
                               state_.engine_panel.profile};
        search.start(scene, of, first,
                     [requested, work](const SearchTools& tools, const Settings& settings, const auto& show) {
                         return work(tools, settings, requested, show);
                     });
    };
    request(requests.tune.has_value(), [&] { start(bias_search_, "the present bias", *requests.tune, search_bias); });
    if (requests.cancel_tune) bias_search_.cancel();
    request(requests.find_fixes.has_value(), [&] {
        EditorSearch<FixesFound>& search = requests.find_fixes->pixel ? pixel_fixes_ : fixes_;
        search.forget();
        start(search, "the present settings",
              fix_options(state_.settings, shown.readings.diagnoses, *requests.find_fixes),
              [](const SearchTools& t, const Settings& settings, const FixOptions& options, const auto& show) {
                  const auto found = [&](FixTable table) { return FixesFound{std::move(table), options.pixel}; };
                  return found(find_fixes(t, settings, options, [&](const FixTable& so_far) { show(found(so_far)); }));
              });
    });
    if (requests.cancel_fixes) fixes_.cancel();
    if (requests.cancel_pixel_fixes) pixel_fixes_.cancel();
    request(requests.forget_fixes, [&] { fixes_.forget(); });
    request(requests.forget_pixel_fixes, [&] { pixel_fixes_.forget(); });
    request(requests.find_advice.has_value(), [&] {
        advice_.forget();
        start(advice_, "the present settings", *requests.find_advice, search_advice);
    });
    if (requests.cancel_advice) advice_.cancel();
    request(requests.find_waste, [&] {
        waste_.forget();
        start(waste_, "the whole frame", shown.request, search_waste);
    });
    if (requests.cancel_waste) waste_.cancel();
    request(requests.compare_pipelines, [&] {
        start(pipelines_, "four pipelines", std::monostate(),
              [](const SearchTools& t, const Settings& settings, std::monostate, const auto&) {
                  return compare_pipelines(t.renderer, t.scene, settings, t.width, t.height);
              });
    });
    if (requests.cancel_pipelines) pipelines_.cancel();
    request(requests.measure_shimmer.has_value(),
            [&] { start(shimmer_, "the first frame", *requests.measure_shimmer, search_shimmer); });
    if (requests.cancel_shimmer) shimmer_.cancel();
    request(requests.measure_along || requests.measure_day, [&] {
        const LightPath path = requests.measure_day
                                   ? day_path(*requests.measure_day, requests.path_steps, state_.settings)
                                   : straight_path(*requests.measure_along, requests.path_steps, state_.settings);
        light_path_.forget();
        start(light_path_, "the first step", path, search_light_path);
    });
    if (requests.cancel_path) light_path_.cancel();
    request(requests.measure_conversion, [&] {
        start(conversion_, "tilt of lit pixels", printable(state_.scene_name),
              [](const SearchTools& t, const Settings& settings, const std::string& name, const auto&) {
                  return measure_conversion(t, settings, name, kDefaultCost);
              });
    });
    if (requests.cancel_conversion) conversion_.cancel();
    request(requests.cancel_measuring, [&] { optimisation_times_.cancel(); });
    request(requests.measure_saved_times,
            [&] { start(optimisation_times_, "the first frame", shown.request, search_saved_times); });
    request(requests.start_sweep.has_value(), [&] { sweep_.start(scenes.require(), state_, *requests.start_sweep); });
    request(requests.cancel_sweep, [&] { sweep_.cancel(); });
    request(requests.open_sweep.has_value(), [&] { open_sweep(*requests.open_sweep); });
    request(requests.save_sweep.has_value(), [&] {
        sweep_.save(*requests.save_sweep);
        state_.log.add(LogKind::Info, "Saved " + *requests.save_sweep + "/report.html and its tables");
    });
    request(requests.apply_sweep_base, [&] { apply_sweep_base(); });
    return changed;
}

bool BackgroundWork::update(const Scene* scene, const EditorRequests& requests) {
    if (requests.want_present && scene)
        sweep_.measure_present(*scene, state_);
    else
        sweep_.stop_measuring_present();
    const bool had_problem = !sweep_.facts().problem.empty();
    const bool changed = sweep_.update(state_);
    if (!had_problem && !sweep_.facts().problem.empty()) report(state_, "The sweep ended: " + sweep_.facts().problem);
    return changed;
}

const MeasuredConversion* BackgroundWork::measured_conversion(const Scene* scene, glm::ivec2 size) const {
    const SearchSubject present{scene ? scene->id : 0, state_.settings, size.x, size.y};
    return conversion_.subject().measures_like(present) ? conversion_.found_in(present.scene) : nullptr;
}

void BackgroundWork::fill(EditorFrame& f, const Scene* scene, glm::ivec2 size) const {
    const SearchSubject present{scene ? scene->id : 0, state_.settings, size.x, size.y, state_.engine_panel.profile};
    f.tuning = bias_search_.progress();
    if (const Tuned* found = bias_search_.found_in(present.scene)) {
        f.tuned = &found->bias;
        f.tuned_result = found->result ? &*found->result : nullptr;
        f.tuned_current = is_current(bias_search_.subject(), present);
    }
    const auto fill_fixes = [&](FixSearch& shown, const EditorSearch<FixesFound>& search) {
        shown.running = search.progress();
        const FixesFound* const found = search.found_in(present.scene);
        if (!found) return;
        shown.table = &found->table;
        shown.pixel = found->pixel;
        shown.current = search.subject().searches_like(present);
    };
    fill_fixes(f.fixes, fixes_);
    fill_fixes(f.pixel_fixes, pixel_fixes_);
    f.measuring_optimisations = optimisation_times_.progress();
    f.saved = optimisation_times_.found_in(present.scene);
    const SearchSubject& timed = optimisation_times_.subject();
    f.saved_times_current = f.saved && timed.draws_like(present);
    f.wasting = waste_.progress();
    f.waste = waste_.found_in(present.scene);
    f.waste_current = f.waste && waste_.subject().draws_like(present);
    f.advising = advice_.progress();
    if (const AdviceFound* found = advice_.found_in(present.scene)) {
        f.advice = std::get_if<AdviceReport>(found);
        f.autopilot = std::get_if<AutopilotResult>(found);
        f.advice_current = advice_.subject().searches_like(present);
    }
    f.comparing_pipelines = pipelines_.progress();
    if (const auto* errors = pipelines_.found()) {
        f.pipelines = *errors;
        // All pipelines are compared, so that the chosen one does not matter.
        SearchSubject of = pipelines_.subject();
        of.settings.map.origin = state_.settings.map.origin;
        of.settings.map.transform = state_.settings.map.transform;
        f.pipelines_current = of.measures_like(present);
    }
    f.measuring_shimmer = shimmer_.progress();
    if (const ShimmerFound* found = shimmer_.found()) {
        f.shimmer = found->variants;
        f.shimmer_of = found->options;
        f.shimmer_current = shimmer_.subject().measures_like(present);
    }
    f.measuring_path = light_path_.progress();
    f.path = light_path_.found_in(present.scene);
    if (f.path && !f.path->steps.empty()) {
        // The path sets the light's direction, so that the shown one does not matter.
        const auto at_begin = [&](SearchSubject of) {
            of.settings = settings_at(of.settings, f.path->path.points.front());
            return of;
        };
        f.path_current = at_begin(light_path_.subject()).measures_like(at_begin(present));
    }
    f.sweep = &sweep_.facts();
}

}  // namespace si
