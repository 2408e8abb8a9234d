// Benchmarks of look-ups with an optimisation and without, in turn: with cached maps and bounds (moving camera) and
// with everything drawn again (moving light).
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>

#include "app/context/headless_context.h"
#include "renderer/base/median.h"
#include "renderer/optimisations/optimisations.h"
#include "renderer/render/renderer.h"
#include "renderer/settings/param.h"
#include "tests/bench/load_bench.h"
#include "tests/bench/rotation.h"
#include "tests/bench/rounds.h"
#include "tests/support/agreed_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

struct LookupCase {
    const char* kernel;
    Optimisation saving;
    Sets sets;
    bool ground_casts = true;
};

double drawn_ms(Renderer& renderer, const Scene& scene, const Settings& s, const FrameRequest& request) {
    return finished_ms([&] { renderer.render(scene, s, request); });
}

void lookups(benchmark::State& state, const LookupCase& c, bool again) {
    HeadlessContext context;
    Renderer saving, forced;
    const Scene scene = test::agreed_scene(test::AgreedSize::Triangles100k);
    Settings s;
    set_setting(s, "filter.kernel", c.kernel);
    set_setting(s, "bias.kind", "adaptive");
    set_all(s, c.sets);
    if (!c.ground_casts) s.objects["ground"].cast = false;
    FrameRequest request{.width = 1280, .height = 720}, all = request;
    all.forced = {c.saving};
    request.force = all.force = again;
    std::vector<double> ratios, ms;
    int round = 0;
    const auto both = [&] {
        s.shading.ambient += 1e-4;            // changes the picture and keeps the maps, as a moving camera does
        const bool first = ++round % 2 != 0;  // the order alternates
        const double a = first ? drawn_ms(saving, scene, s, request) : 0;
        const double b = drawn_ms(forced, scene, s, all);
        ms.push_back(first ? a : drawn_ms(saving, scene, s, request));
        ratios.push_back(ms.back() / b);
    };
    for (int i = 0; i < 2; ++i) both();
    ratios.clear();
    ms.clear();
    for (auto _ : state) {
        both();
        state.SetIterationTime(ms.back() / 1000);
    }
    state.counters["ms"] = median(ms);
    report_ratio(state, std::move(ratios));
}

}  // namespace

void register_lookup_benchmarks(int rounds) {
    std::vector<LookupCase> cases;
    for (const char* taps : {"16", "32", "64"})
        for (const char* kernel : {"poisson", "vogel", "pcss", "dpcf"})
            cases.push_back({kernel, Optimisation::EarlyOut, {{"filter.taps", taps}, {"filter.blocker_taps", taps}}});
    for (const char* size : {"7", "9", "15"})
        for (const char* kernel : {"pcf", "gauss"})
            cases.push_back({kernel, Optimisation::EarlyOut, {{"filter.size", size}}});
    cases.push_back({"smrt", Optimisation::EarlyOut, {}});
    cases.push_back({"smrt", Optimisation::EarlyOut, {"filter.rays=32"}});
    cases.push_back({"pcss", Optimisation::BlockerSearch, {"light.size=0"}});
    cases.push_back({"hard", Optimisation::BackFacingReceivers, {}});
    cases.push_back({"pcf3", Optimisation::BackFacingReceivers, {}});
    for (const char* kernel : {"hard", "pcf5"})  // one light of four shines
        cases.push_back({kernel,
                         Optimisation::DeadPasses,
                         {"light.count=4", "light.1.intensity=0", "light.2.intensity=0", "light.3.intensity=0"}});
    for (const char* kernel : {"hard", "pcf5"})  // nothing casts below three of four lights
        cases.push_back(
            {kernel,
             Optimisation::DeadPasses,
             {"light.count=4", "light.1.type=spot", "light.2.type=spot", "light.3.type=spot", "light.1.elevation=90",
              "light.2.elevation=90", "light.3.elevation=90", "light.1.distance=1.5", "light.2.distance=1.5",
              "light.3.distance=1.5", "light.1.target_y=0", "light.2.target_y=0", "light.3.target_y=0",
              "light.1.target_x=19.2", "light.2.target_x=-19.2", "light.3.target_z=19.2"},
             false});
    for (const LookupCase& c : cases)
        for (const bool again : {false, true})
            benchmark::RegisterBenchmark(
                fmt::format("lookups/{}/{}/{}", row_of(c.saving).key, c.kernel, again ? "anew" : "kept").c_str(),
                [c, again](benchmark::State& state) { lookups(state, c, again); })
                ->UseManualTime()
                ->Unit(benchmark::kMillisecond)
                ->Iterations(rounds);
}

}  // namespace si
