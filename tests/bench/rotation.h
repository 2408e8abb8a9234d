// Alternating timing of several contenders, so that drift of the machine affects all equally. Compare ratios within one
// run; milliseconds hold for one machine and run only.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace si {

/// Returns the milliseconds of a draw, with glFinish() before and after.
double finished_ms(const std::function<void()>& draw);

/// Contenders of one benchmark, timed in turns.
class Rotation {
public:
    /// Adds a contender by a function that returns its milliseconds. The first contender is the benchmark's own time.
    void add(std::string name, std::function<double()> ms);
    /// Adds a draw as a contender, timed by finished_ms().
    void add_draw(std::string name, std::function<void()> draw);
    /// Warms up all contenders, then times each once a round. Each round starts with another contender.
    void run(benchmark::State& state);
    /// Reports the time of contender `a` divided by that of `b`, round by round. Counter NAME is the median, NAME_low
    /// and NAME_high its 95 % bootstrap interval, NAME_p25 and NAME_p75 the quartiles. Draws also report NAME_cpu with
    /// its interval: the ratio of processor times of all threads, which is less noisy on a CPU driver.
    void ratio(benchmark::State& state, const std::string& name, const std::string& a, const std::string& b) const;

private:
    struct Contender {
        std::string name;
        std::function<double()> ms;
        bool draws = false;
        std::vector<double> times, cpu;  ///< ms
    };
    const Contender& of(const std::string& name) const;
    std::vector<Contender> contenders_;
};

}  // namespace si
