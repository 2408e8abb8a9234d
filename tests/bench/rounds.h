// Measured in turn, round by round, so that drift of the machine falls on all alike.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <vector>

#include "tests/bench/median.h"

namespace si {

/// Rounds per benchmark: SI_BENCH_ROUNDS, else `otherwise`.
inline int bench_rounds(int otherwise) {
    const char* text = std::getenv("SI_BENCH_ROUNDS");
    return text ? std::clamp(std::atoi(text), 1, 10000) : otherwise;
}

/// What many measurements say.
struct Quartiles {
    double median = 0, p25 = 0, p75 = 0;

    Quartiles() = default;
    /// @param v not empty
    explicit Quartiles(std::vector<double> v) {
        std::sort(v.begin(), v.end());
        median = v[v.size() / 2];
        p25 = v[v.size() / 4];
        p75 = v[v.size() * 3 / 4];
    }
};

/// Time that all threads of the process have worked, milliseconds.
inline double processor_ms() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

/// Wall time of a call, milliseconds.
template <typename Work>
double wall_ms(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace si
