// Rounds, quartiles and clocks of alternating measurements.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <vector>

#include "renderer/base/median.h"

namespace si {

/// Returns the rounds a benchmark: $SI_BENCH_ROUNDS, clamped to 1 ... 10000, else `otherwise`.
inline int bench_rounds(int otherwise) {
    const char* text = std::getenv("SI_BENCH_ROUNDS");
    return text ? std::clamp(std::atoi(text), 1, 10000) : otherwise;
}

/// Median and quartiles of a set of measurements.
struct Quartiles {
    double median = 0, p25 = 0, p75 = 0;

    Quartiles() = default;
    /// Computes the quartiles of `v`. @param v not empty
    explicit Quartiles(std::vector<double> v) {
        std::sort(v.begin(), v.end());
        median = v[v.size() / 2];
        p25 = v[v.size() / 4];
        p75 = v[v.size() * 3 / 4];
    }
};

/// Returns the processor time of all threads of the process, milliseconds.
inline double processor_ms() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

/// Returns the wall time of one call of `work`, milliseconds.
template <typename Work>
double wall_ms(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Reports the ratios of timed pairs as counters: their median and the middle half.
inline void report_ratio(benchmark::State& state, std::vector<double> ratios) {
    const Quartiles ratio(std::move(ratios));
    state.counters["ratio"] = ratio.median;
    state.counters["ratio_p25"] = ratio.p25;
    state.counters["ratio_p75"] = ratio.p75;
}

}  // namespace si
