// Alternating timing of contenders, with bootstrap intervals of their ratios.
#include "tests/bench/rotation.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "renderer/base/error.h"
#include "tests/bench/rounds.h"

namespace si {
namespace {

struct Interval {
    double median, low, high;  ///< median and its 95 % interval
};

/// Returns a bootstrap interval of a median.
Interval bootstrapped(const std::vector<double>& values) {
    std::mt19937 dice(1);
    std::uniform_int_distribution<std::size_t> any(0, values.size() - 1);
    std::vector<double> medians(1000), again(values.size());
    for (double& m : medians) {
        for (double& v : again) v = values[any(dice)];
        m = median(again);
    }
    std::sort(medians.begin(), medians.end());
    return {median(values), medians[25], medians[974]};
}

std::vector<double> quotients(const std::vector<double>& x, const std::vector<double>& y) {
    std::vector<double> out(x.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = x[i] / y[i];
    return out;
}

}  // namespace

double finished_ms(const std::function<void()>& draw) {
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    draw();
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void Rotation::add(std::string name, std::function<double()> ms) {
    contenders_.push_back({.name = std::move(name), .ms = std::move(ms)});
}

void Rotation::add_draw(std::string name, std::function<void()> draw) {
    add(std::move(name), [draw = std::move(draw)] { return finished_ms(draw); });
    contenders_.back().draws = true;
}

void Rotation::run(benchmark::State& state) {
    for (int i = 0; i < 3; ++i)  // first use compiles
        for (const Contender& c : contenders_) c.ms();
    std::size_t first = 0;
    for (auto _ : state) {
        for (std::size_t i = 0; i < contenders_.size(); ++i) {
            Contender& c = contenders_[(first + i) % contenders_.size()];
            const double before = processor_ms();
            c.times.push_back(c.ms());
            c.cpu.push_back(processor_ms() - before);
        }
        ++first;
        state.SetIterationTime(contenders_.front().times.back() / 1000);
    }
    for (const Contender& c : contenders_) state.counters[c.name + "_ms"] = median(c.times);
}

const Rotation::Contender& Rotation::of(const std::string& name) const {
    for (const Contender& c : contenders_)
        if (c.name == name) return c;
    throw Error("no contender " + name);
}

void Rotation::ratio(benchmark::State& state, const std::string& name, const std::string& a,
                     const std::string& b) const {
    const auto report = [&](const std::string& label, const Interval& i) {
        state.counters[label] = i.median;
        state.counters[label + "_low"] = i.low;
        state.counters[label + "_high"] = i.high;
    };
    std::vector<double> ratios = quotients(of(a).times, of(b).times);
    report(name, bootstrapped(ratios));
    std::sort(ratios.begin(), ratios.end());
    state.counters[name + "_p25"] = ratios[ratios.size() / 4];
    state.counters[name + "_p75"] = ratios[ratios.size() * 3 / 4];
    if (of(a).draws && of(b).draws) report(name + "_cpu", bootstrapped(quotients(of(a).cpu, of(b).cpu)));
}

}  // namespace si
