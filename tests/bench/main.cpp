// bench [--benchmark_...]          runs benchmarks, see README
// bench --gpu-report FILE ...      writes the preferred choices of this driver as JSON; see kUsage
// bench --draw-curves JSON PNG     draws the picture of docs/lab/performance.md from the results of curve/
#include <benchmark/benchmark.h>

#include <cstdio>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "app/commands/commands.h"
#include "renderer/base/error.h"
#include "renderer/scenes/foreign_jobs.h"
#include "tests/bench/curves.h"
#include "tests/bench/gpu_report.h"
#include "tests/bench/load_bench.h"
#include "tests/bench/rounds.h"

namespace {

constexpr const char* kUsage =
    "bench --gpu-report FILE [--choices A,B] [--size WxH]\n"
    "    Measures which way of each choice this driver prefers, and writes it as JSON.\n"
    "    --choices A,B   only those whose key begins with A or B, such as light_loop/1,saving/ (default: all)\n"
    "    --size WxH      of the pictures in pixels (default 1280x720)\n"
    "    SI_BENCH_ROUNDS says how often both ways are timed (default 15)\n"
    "bench --draw-curves JSON PNG\n"
    "    Draws what --benchmark_filter=^curve/ wrote.\n";

/// Parses the options of --gpu-report. @throws UsageError for wrong arguments
si::GpuReportOptions report_options(std::span<char*> arguments) {
    si::GpuReportOptions options{.rounds = si::bench_rounds(15)};
    for (std::size_t i = 0; i < arguments.size(); i += 2) {
        const std::string option = arguments[i];
        if (i + 1 == arguments.size() || (option != "--choices" && option != "--size")) throw si::UsageError(kUsage);
        const std::string value = arguments[i + 1];
        if (option == "--size") {
            const si::PictureSize size = si::parse_size(value);
            options.width = size.width;
            options.height = size.height;
            continue;
        }
        std::istringstream keys(value);
        for (std::string key; std::getline(keys, key, ',');) options.choices.push_back(key);
    }
    return options;
}

/// Returns the exit code, or -1 if benchmarks are to be run. @throws si::Error
int run_command(std::span<char*> arguments) {
    const std::string_view first = arguments.empty() ? "" : arguments[0];
    if (first != "--gpu-report" && first != "--draw-curves") return -1;
    const bool report = first == "--gpu-report";
    if (report ? arguments.size() < 2 : arguments.size() != 3) throw si::UsageError(kUsage);
    if (report)
        si::write_gpu_report(arguments[1], report_options(arguments.subspan(2)));
    else
        si::draw_curves(arguments[1], arguments[2]);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    si::foreign_child_main(argc, argv, si::foreign_jobs());
    try {
        const int code = run_command(std::span(argv + 1, argv + argc));
        if (code >= 0) return code;
    } catch (const si::UsageError& e) {
        std::fprintf(stderr, "bench: %s\n", e.what());
        return 2;
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
