// Benchmarks of classification: comparing every pixel with the reference and trying causes for wrong pixels, relative
// to drawing visibility in the same frames. Compare the ratios: for changes of bias or kernel, and with everything that
// is cached for a fixed camera and light.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "app/context/headless_context.h"
#include "renderer/base/median.h"
#include "renderer/measure/measured_error.h"
#include "renderer/reference/live_error.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/sets.h"

namespace si {
namespace {

void classify_over_visibility(benchmark::State& state, const char* scene_name, Sets sets) {
    const HeadlessContext context;
    Renderer renderer;
    const Scene scene = load_scene(scene_name);
    Settings s;
    for (const auto& [key, value] : scene.suggested) set_setting(s, key, value);
    set_setting(s, "light.fit", "scene");  // a map with enough wrong pixels
    set_all(s, sets);
    FrameRequest request{.width = 1280, .height = 720, .outputs = {.colour = false, .error = true}};
    ReferenceCache cache;
    render_with_reference(renderer, scene, s, request, cache);
    request.timing = request.force = true;
    std::vector<double> ratios, moved, classifying, visibility, compared, causes, unfiltered, seen;
    double wrong = 0;
    for (auto _ : state) {
        const FrameResult f = renderer.render(scene, s, request);
        const auto ms = [&](const char* name) { return f.pass(name) ? f.pass(name)->gpu_ms : 0; };
        compared.push_back(ms("pixels compared"));
        causes.push_back(ms("causes found"));
        unfiltered.push_back(ms("unfiltered map"));
        seen.push_back(ms("visible surfaces"));
        classifying.push_back(compared.back() + causes.back());
        visibility.push_back(ms("visibility"));
        ratios.push_back(classifying.back() / visibility.back());
        moved.push_back((classifying.back() + seen.back() + unfiltered.back()) / visibility.back());
        wrong = f.error->metrics.false_light + f.error->metrics.false_shadow;
    }
    state.counters["judging_ms"] = median(classifying);
    state.counters["compared_ms"] = median(compared);
    state.counters["causes_ms"] = median(causes);
    state.counters["surfaces_ms"] = median(seen);
    state.counters["unfiltered_map_ms"] = median(unfiltered);
    state.counters["visibility_ms"] = median(visibility);
    state.counters["ratio"] = median(ratios);
    state.counters["ratio_all_anew"] = median(moved);
    state.counters["wrong_share"] = wrong;
}

BENCHMARK_CAPTURE(classify_over_visibility, stage_pcf3, "stage", Sets{})->Iterations(15)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(classify_over_visibility, stage_pcf9, "stage", Sets{"filter.kernel=pcf9"})
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(classify_over_visibility, boxes_pcf3, "boxes", Sets{})->Iterations(15)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace si
