// Benchmarks of effect reports and of planning: their times as shares of a frame, in turns with frames. An unchanged
// frame is planning alone.
#include <benchmark/benchmark.h>

#include <cmath>

#include "app/context/headless_context.h"
#include "renderer/base/median.h"
#include "renderer/inspect/effects.h"
#include "renderer/render/renderer.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/bench/rotation.h"
#include "tests/support/agreed_scene.h"

namespace si {
namespace {

void effects_of_a_frame(benchmark::State& state, const Scene& scene, const char* lights) {
    const HeadlessContext context;
    Renderer renderer;
    Settings settings;
    for (const auto& [key, value] : scene.suggested) set_setting(settings, key, value);
    set_setting(settings, "light.count", lights);
    FrameRequest request;
    FrameResult frame = renderer.render(scene, settings, request);
    std::vector<double> frames, analyses, unchanged;
    for (auto _ : state) {
        request.force = true;
        frames.push_back(finished_ms([&] { frame = renderer.render(scene, settings, request); }));
        analyses.push_back(finished_ms([&] { benchmark::DoNotOptimize(frame_effects(scene, settings, frame)); }));
        request.force = false;
        renderer.render(scene, settings, request);
        unchanged.push_back(finished_ms([&] { renderer.render(scene, settings, request); }));
        state.SetIterationTime(1e-3 * analyses.back());
    }
    state.counters["frame_ms"] = median(frames);
    state.counters["effects_share"] = median(analyses) / median(frames);
    state.counters["unchanged_share"] = median(unchanged) / median(frames);
}

void effects_agreed(benchmark::State& state) {
    effects_of_a_frame(state, test::agreed_scene(test::AgreedSize::Triangles100k), "1");
}
void effects_stage_of_four_lights(benchmark::State& state) {
    effects_of_a_frame(state, load_scene("stage"), "4");
}
void effects_of_ten_thousand_objects(benchmark::State& state) {
    Scene scene = load_scene("boxes");
    const Object last = scene.objects.back();
    while (scene.objects.size() < 10'000) {
        Object copy = last;
        const auto n = double(scene.objects.size());
        copy.instance[3] += glm::dvec4(std::fmod(n, 100) - 50, 0, n / 100 - 50, 0);
        scene.objects.push_back(copy);
    }
    finalise(scene);
    effects_of_a_frame(state, scene, "1");
}

BENCHMARK(effects_agreed)->UseManualTime()->Iterations(15)->Unit(benchmark::kMillisecond);
BENCHMARK(effects_stage_of_four_lights)->UseManualTime()->Iterations(15)->Unit(benchmark::kMillisecond);
BENCHMARK(effects_of_ten_thousand_objects)->UseManualTime()->Iterations(15)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace si
