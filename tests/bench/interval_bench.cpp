// Benchmark of the clock: the interval of a whole frame's time, with and without busy processes beside it, in turn.
#include <benchmark/benchmark.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include "app/context/headless_context.h"
#include "renderer/measure/measure.h"
#include "renderer/settings/param.h"
#include "tests/bench/rounds.h"
#include "tests/support/agreed_scene.h"

namespace si {
namespace {

constexpr int kBusyProcesses = 8, kBlockFrames = 5;

/// Processes that compute without pause until the object ends.
class BusyProcesses {
public:
    explicit BusyProcesses(int count) {
        for (int i = 0; i < count; ++i) {
            const pid_t child = ::fork();
            if (child == 0) {
                ::prctl(PR_SET_PDEATHSIG, SIGKILL);
                for (unsigned busy = 0;; ++busy) benchmark::DoNotOptimize(busy);
            }
            if (child > 0) children_.push_back(child);
        }
    }
    ~BusyProcesses() {
        for (const pid_t child : children_) {
            ::kill(child, SIGKILL);
            ::waitpid(child, nullptr, 0);
        }
    }
    BusyProcesses(const BusyProcesses&) = delete;
    BusyProcesses& operator=(const BusyProcesses&) = delete;

private:
    std::vector<pid_t> children_;
};

/// Times forced frames of PCF 3 x 3 in blocks, without and with busy processes in turn. Counters: median and half the
/// 95 % interval of both, and the ratio of the medians.
void interval_of_a_frame(benchmark::State& state) {
    const HeadlessContext context;
    Renderer renderer;
    const Scene scene = test::agreed_scene(test::AgreedSize::Triangles100k);
    Settings settings;
    for (const auto& [key, value] : scene.suggested) set_setting(settings, key, value);
    set_setting(settings, "filter.kernel", "pcf3");
    Measurer measurer(renderer, 1280, 720);
    TimedFrames frames = measurer.frames(scene, settings, CostCase::Forced);
    frames.warm_up();
    TimeSamples quiet, busy;
    for (auto _ : state) {
        const int rounds = bench_rounds(40);
        for (int round = 0; round < rounds; ++round)
            for (const bool loaded : {round % 2 != 0, round % 2 == 0}) {
                const BusyProcesses beside(loaded ? kBusyProcesses : 0);
                frames.draw_next();
                TimeSamples block;
                for (int i = 0; i < kBlockFrames; ++i) block.add(frames.draw_next());
                (loaded ? busy : quiet).add(block);
            }
    }
    const Spread alone = summarise_times(quiet).total_ms, beside = summarise_times(busy).total_ms;
    state.SetLabel(quiet.clock);
    state.counters["alone_ms"] = alone.median;
    state.counters["alone_half_percent"] = 100 * alone.relative();
    state.counters["beside_8_ms"] = beside.median;
    state.counters["beside_8_half_percent"] = 100 * beside.relative();
    state.counters["ratio"] = beside.median / alone.median;
}

BENCHMARK(interval_of_a_frame)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace si
