#include "renderer/measure/saved.h"

#include <algorithm>

namespace si {
namespace {

/// spread_of() of numbers of either sign, which it takes for times.
Spread spread_of_differences(std::vector<double> values) {
    if (values.empty()) return {};
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double shift = 2 * (*most - *least) - *least;
    for (double& v : values) v += shift;
    Spread s = spread_of(std::move(values));
    for (double* v : {&s.median, &s.p95, &s.low, &s.high, &s.median_low, &s.median_high}) *v -= shift;
    return s;
}

double total_ms(const FrameResult& frame) {
    double total = 0;
    for (const PassInfo& pass : frame.passes)
        if (pass.state == PassState::Ran) total += pass.gpu_ms;
    return total;
}

}  // namespace

const Spread* SavedTimes::of(Saving saving) const {
    for (const SavedTime& time : savings)
        if (time.saving == saving) return &time.ms;
    return nullptr;
}

const Spread* SavedTimes::of(const Effect& effect) const {
    if (effect.saving) return of(*effect.saving);
    if (effect.state != EffectState::Reused || effect.part) return nullptr;
    for (const PassTime& pass : frame.passes)
        if (pass.name == effect.pass) return &pass.gpu_ms;
    return nullptr;
}

std::vector<SavedTime> saved_in_turns(std::span<const Saving> savings, int rounds,
                                      const std::function<double(SavingSet)>& draw_ms,
                                      const std::function<void(double)>& report) {
    std::vector<std::vector<double>> differences(savings.size());
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < savings.size(); ++i) {
            // Whichever comes first finds caches as the one before left them: each is first every other time.
            double with = 0, without = 0;
            if (round % 2 == 0) with = draw_ms({});
            without = draw_ms({savings[i]});
            if (round % 2 != 0) with = draw_ms({});
            differences[i].push_back(without - with);
            if (report) report(double(round * int(savings.size()) + int(i) + 1) / (rounds * int(savings.size())));
        }
    std::vector<SavedTime> out;
    for (std::size_t i = 0; i < savings.size(); ++i)
        out.push_back({savings[i], spread_of_differences(std::move(differences[i]))});
    return out;
}

SavedTimes measure_saved(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest request,
                         std::span<const Saving> savings, int rounds, const Workers& workers,
                         const std::function<void(double)>& report) {
    request.force = request.timing = true;
    TimeSamples samples;
    const auto draw = [&](SavingSet forced, bool counts) {
        if (workers.stop.stop_requested()) throw Cancelled();
        request.forced = forced;
        const FrameResult frame = renderer.render(scene, settings, request);
        if (counts && forced.empty()) samples.add(frame);
        return total_ms(frame);
    };
    draw({}, false);  // compiles programs and touches memory
    for (const Saving saving : savings) draw({saving}, false);
    SavedTimes saved{.rounds = rounds};
    saved.savings = saved_in_turns(
        savings, rounds, [&](SavingSet forced) { return draw(forced, true); }, report);
    for (int i = 0; savings.empty() && i < rounds; ++i) {
        draw({}, true);
        if (report) report(double(i + 1) / rounds);
    }
    saved.frame = summary(samples);
    return saved;
}

std::vector<Saving> named_savings(std::span<const Effect> effects) {
    std::vector<Saving> out;
    // What rests is kept from the frame before, and frames that are measured keep nothing.
    for (const Effect& effect : effects)
        if (effect.saving && *effect.saving != Saving::Resting &&
            std::find(out.begin(), out.end(), *effect.saving) == out.end())
            out.push_back(*effect.saving);
    return out;
}

}  // namespace si
