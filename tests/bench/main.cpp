// bench [--benchmark_...]          measures, see README
// bench --gpu-report FILE          which way of each choice this driver prefers, as JSON
// bench --draw-curves JSON PNG     the picture of docs/performance.md, of what curve/ wrote
#include <benchmark/benchmark.h>

#include <cstdio>
#include <span>
#include <string_view>

#include "renderer/base/error.h"
#include "tests/bench/curves.h"
#include "tests/bench/gpu_report.h"
#include "tests/bench/load_bench.h"
#include "tests/bench/rounds.h"

namespace {

/// Exit code, or -1 where benchmarks are to be run. @throws si::Error
int run_command(std::span<char*> arguments) {
    const std::string_view first = arguments.empty() ? "" : arguments[0];
    if (first != "--gpu-report" && first != "--draw-curves") return -1;
    const bool report = first == "--gpu-report";
    if (arguments.size() != (report ? 2u : 3u)) {
        std::fputs("bench: --gpu-report FILE, or --draw-curves JSON PNG\n", stderr);
        return 2;
    }
    if (report)
        si::write_gpu_report(arguments[1], si::bench_rounds(15));
    else
        si::draw_curves(arguments[1], arguments[2]);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int code = run_command(std::span(argv + 1, argv + argc));
        if (code >= 0) return code;
    } catch (const si::Error& e) {
        std::fprintf(stderr, "bench: %s\n", e.what());
        return 1;
    }
    si::register_frame_benchmarks();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
