// Benchmarks of the autopilot: its result compared with the best of all combinations. All are classified against the
// reference, those within the bound are timed in turns, and the result is drawn in turns with the fastest.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include "app/context/headless_context.h"
#include "renderer/advise/autopilot.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/bench/rotation.h"
#include "tests/bench/rounds.h"

namespace si {
namespace {

constexpr int kPilotWidth = 640, kPilotHeight = 360;

double steady_wall_ms() {
    return BurstClock::steady().now_s() * 1e3;
}

/// Returns the milliseconds a frame while the camera moves, after warm-up frames.
double moving_frame_ms(TimedFrames& frames, double (*clock)()) {
    constexpr int kFrames = 4;
    frames.warm_up();
    glFinish();
    const double before = clock();
    for (int i = 0; i < kFrames; ++i) frames.draw_next();
    glFinish();
    return (clock() - before) / kFrames;
}

const std::vector<SweepAxis>& searched_axes() {
    static const std::vector<SweepAxis> all = {{"filter.kernel", {"", "hard", "pcf3", "pcf5", "pcss"}},
                                               {"map.resolution", {"", "256", "512", "1024", "4096"}},
                                               {"map.format", {"", "d16"}}};
    return all;
}

/// Compares the autopilot's result with the best combination by time. @param max_combinations limit for exhaustive
/// search; larger spaces are searched by parts
void autopilot_by_clock(benchmark::State& state, const char* name, double share, std::size_t max_combinations) {
    const HeadlessContext context;
    Renderer renderer;
    const Scene scene = load_scene(name);
    Settings settings;
    for (const auto& [key, value] : scene.suggested) set_setting(settings, key, value);
    settings = measured_settings(settings);
    ReferenceCache cache;
    TrialMeter counted = renderer_trial_meter({renderer, scene, kPilotWidth, kPilotHeight, cache});
    counted.ms = [](const Settings&) { return CostChange{1, 0}; };
    counted.time = [](const Settings&, const Settings&) { return CostChange{}; };
    counted.now_s = [] { return 0.0; };
    std::vector<AutopilotCase> all = run_autopilot(settings, searched_axes(), {.max_error = 1}, counted).cases;
    std::vector<double> errors;
    for (const AutopilotCase& c : all) errors.push_back(c.classified.error);
    std::sort(errors.begin(), errors.end());
    const AutopilotGoals goals{.max_error = errors[std::size_t(share * double(errors.size() - 1))],
                               .max_combinations = max_combinations};
    std::erase_if(all, [&](const AutopilotCase& c) { return c.classified.error > *goals.max_error; });

    Measurer measurer(renderer, kPilotWidth, kPilotHeight);
    std::vector<TimedFrames> frames;
    for (const AutopilotCase& c : all) frames.push_back(measurer.frames(scene, c.settings, kDefaultCost));
    std::vector<std::vector<double>> ms(all.size());
    for (int round = 0; round < bench_rounds(9); ++round)
        for (std::size_t i = 0; i < all.size(); ++i) ms[i].push_back(moving_frame_ms(frames[i], processor_ms));
    std::size_t optimum = 0;
    std::vector<double> medians;
    for (const auto& of : ms) medians.push_back(median(of));
    optimum = std::size_t(std::min_element(medians.begin(), medians.end()) - medians.begin());

    const AutopilotResult found =
        run_rendered_autopilot({renderer, scene, kPilotWidth, kPilotHeight, cache}, settings, goals, searched_axes());
    TimedFrames pick = measurer.frames(scene, found.best.settings, kDefaultCost);
    Rotation turns;
    turns.add("pick", [&] { return moving_frame_ms(pick, processor_ms); });
    turns.add("optimum", [&] { return moving_frame_ms(frames[optimum], processor_ms); });
    turns.add("pick_wall", [&] { return moving_frame_ms(pick, steady_wall_ms); });
    turns.add("optimum_wall", [&] { return moving_frame_ms(frames[optimum], steady_wall_ms); });
    turns.run(state);
    turns.ratio(state, "ratio", "pick", "optimum");
    turns.ratio(state, "ratio_wall", "pick_wall", "optimum_wall");
    state.counters["held"] = found.goals_met;
    state.counters["seconds"] = found.seconds;
    state.counters["combinations"] = double(found.combinations);
    state.counters["judged"] = double(found.cases.size());
    state.counters["that_hold"] = double(all.size());
    state.counters["same"] = found.best.settings == all[optimum].settings;
    state.counters["error"] = found.best.classified.error;
    state.counters["most_error"] = *goals.max_error;
    std::string untried;
    for (const std::string& u : found.untried) untried += "; " + u;
    state.SetLabel(found.summary + untried);
}

void register_autopilot(const char* scene) {
    for (const double share : {0.25, 0.5})
        for (const std::size_t most : {std::size_t(160), std::size_t(16)}) {
            const std::string name = std::string("autopilot_by_clock/") + scene + "/" +
                                     (share < 0.3 ? "quarter" : "half") + (most < 50 ? "/by_parts" : "/all");
            benchmark::RegisterBenchmark(
                name.c_str(), [=](benchmark::State& state) { autopilot_by_clock(state, scene, share, most); })
                ->UseManualTime()
                ->Iterations(bench_rounds(15))
                ->Unit(benchmark::kMillisecond);
        }
}

[[maybe_unused]] const bool kAutopilotRegistered = (register_autopilot("boxes"), register_autopilot("teapot"), true);

}  // namespace
}  // namespace si
