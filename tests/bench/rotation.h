// Contenders timed in turn: what the machine does besides falls on all alike. Read ratios within one run; milliseconds
// hold for this machine and minute only.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace si {

/// Milliseconds of a draw that is finished before and after.
double finished_ms(const std::function<void()>& draw);

class Rotation {
public:
    /// The first contender is the benchmark's own time.
    void add(std::string name, std::function<double()> ms);
    /// The same of a draw, by finished_ms().
    void add_draw(std::string name, std::function<void()> draw);
    /// Warms all up, then times each once in every round, starting with another each time.
    void run(benchmark::State& state);
    /// Reports a's time by b's, round by round: NAME the median, NAME_low and NAME_high its 95 % interval by bootstrap,
    /// NAME_p25 and NAME_p75 the middle half of the rounds. Of draws also NAME_cpu with its interval, the ratio of the
    /// time that all threads of the process worked: where the driver draws on the CPU, others on the machine blur that
    /// far less.
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
