#include "renderer/measure/shadow_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "renderer/measure/measure.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

constexpr double kSettledShare = 0.05, kSettledOfFrame = 0.02;
constexpr int kMaxTurns = 8;

/// Returns which of several comes at a place of a turn. Every other turn goes in reversed order.
int in_turn(int turn, int place, int count) {
    return turn % 2 == 0 ? place : count - 1 - place;
}

/// Appends the indices at which the bursts of further values begin. @param before number of values so far
/// @param first burst starts of the further values; empty: one burst @param count number of further values
void add_bursts(std::vector<std::size_t>& bursts, std::size_t before, const std::vector<std::size_t>& first,
                std::size_t count) {
    if (first.empty() && count > 0) bursts.push_back(before);
    for (const std::size_t index : first) bursts.push_back(before + index);
}

int source_without_shadows() {
    const auto rows = sources();
    return int(std::ranges::find(rows, std::string_view("none"), &Source::key) - rows.begin());
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& base_of_costs() {
    static const std::vector<std::pair<std::string, std::string>> base = {{"filter.kernel", "hard"},
                                                                          {"map.resolution", "1024"}};
    return base;
}

std::string base_of_costs_name() {
    Settings base;
    set_settings(base, base_of_costs());
    return fmt::format("{}, {}²", filter_of(base).label, base.map.resolution);
}

Settings without_shadows(Settings settings) {
    const int none = source_without_shadows();
    for (LightSettings& light : settings.lights) light.source = none;
    return settings;
}

void ShadowSamples::add(const ShadowSamples& more) {
    add_bursts(bursts, moving_ms.size(), more.bursts, more.moving_ms.size());
    add_bursts(still_bursts, still_ms.size(), more.still_bursts, more.still_ms.size());
    moving_ms.insert(moving_ms.end(), more.moving_ms.begin(), more.moving_ms.end());
    still_ms.insert(still_ms.end(), more.still_ms.begin(), more.still_ms.end());
    forced_more_ms.insert(forced_more_ms.end(), more.forced_more_ms.begin(), more.forced_more_ms.end());
}

Spread spread_of_differences(std::vector<double> values, std::span<const std::size_t> bursts) {
    if (values.empty()) return {};
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    // spread_of() expects positive times.
    const double shift = 20 * (*most - *least) - *least;
    for (double& v : values) v += shift;
    Spread s = spread_of(std::move(values), bursts);
    for (double* v : {&s.median, &s.p95, &s.low, &s.high, &s.median_low, &s.median_high}) *v -= shift;
    return s;
}

bool below_noise(const Spread& time) {
    return time.samples < 2 || time.median_low <= 0;
}

double time_or_bound(const Spread& time) {
    return below_noise(time) ? std::max(time.median_high, 0.0) : time.median;
}

double time_ratio(const Spread& time, const Spread& base) {
    if (below_noise(time) || below_noise(base)) return std::numeric_limits<double>::quiet_NaN();
    return time.median / base.median;
}

ShadowTime summarise_shadow(const ShadowSamples& samples) {
    ShadowTime time{.moving_ms = spread_of_differences(samples.moving_ms, samples.bursts),
                    .still_ms = spread_of_differences(samples.still_ms, samples.still_bursts)};
    if (samples.forced_more_ms.empty()) return time;
    // Both parts are uncertain: the interval of the sum is the sum of the intervals.
    Spread forced = spread_of_differences(samples.forced_more_ms);
    for (double Spread::*v :
         {&Spread::median, &Spread::p95, &Spread::low, &Spread::high, &Spread::median_low, &Spread::median_high})
        forced.*v += time.moving_ms.*v;
    time.forced_ms = forced;
    return time;
}

bool shadow_settled(const ShadowSamples& samples, double frame_ms) {
    const Spread moving = spread_of_differences(samples.moving_ms, samples.bursts);
    if (moving.bursts < kMinBursts) return false;
    return moving.noise() <= std::max(kSettledShare * moving.median, kSettledOfFrame * frame_ms);
}

std::vector<std::vector<double>> time_rounds(int rounds, int kinds, const std::function<double(int)>& draw_ms) {
    std::vector<std::vector<double>> ms(static_cast<std::size_t>(kinds));
    for (int round = 0; round < rounds; ++round)
        for (int i = 0; i < kinds; ++i) {
            const int kind = in_turn(round, i, kinds);
            ms[std::size_t(kind)].push_back(draw_ms(kind));
        }
    return ms;
}

std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> out;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) out.push_back(a[i] - b[i]);
    return out;
}

ShadowSamples time_shadow(Measurer& measurer, const Scene& scene, const Settings& settings, int pairs, CostCase cost,
                          TimeSamples* frames, const std::stop_token& stop, ShadowFrames which) {
    const Settings plain = without_shadows(settings);
    // Kinds: 0 with shadows, 1 without, 2 with all optimisations off.
    const auto timed = [&](CostCase moves, int rounds, int second, TimeSamples* add_to) {
        TimedFrames with = measurer.frames(scene, settings, moves),
                    other = measurer.frames(scene, second == 1 ? plain : settings, moves);
        if (second == 2) other.switch_off(OptimisationSet::all());
        other.draw_next();
        with.draw_next();
        // Maps that are kept have been drawn once; where the light moves there are none.
        if (moves == CostCase::Camera) with.draw_next();
        return time_rounds(rounds, 2, [&](int kind) {
            if (stop.stop_requested()) throw Cancelled();
            const FrameResult frame = (kind == 0 ? with : other).draw_next();
            if (kind == 0 && add_to) add_to->add(frame);
            return drawn_ms(frame);
        });
    };
    if (frames && cost == CostCase::Forced) frames->add(measurer.time(scene, settings, pairs, cost));
    const auto moving = timed(CostCase::Light, pairs, 1, cost == CostCase::Light ? frames : nullptr);
    if (which == ShadowFrames::MovingLight) return {.moving_ms = differences(moving[0], moving[1])};
    const auto still = timed(CostCase::Camera, pairs, 1, cost == CostCase::Camera ? frames : nullptr);
    const auto forced = timed(CostCase::Light, 1, 2, nullptr);
    ShadowSamples samples{.moving_ms = differences(moving[0], moving[1]),
                          .still_ms = differences(still[0], still[1]),
                          .forced_more_ms = differences(forced[1], forced[0]),
                          .bursts = {}};
    return samples;
}

std::vector<TurnTimes> time_in_turns(std::size_t count, const std::function<void(std::size_t, TurnTimes&)>& burst) {
    std::vector<TurnTimes> times(count);
    const auto settled = [](const TurnTimes& t) {
        return shadow_settled(t.shadow, lower_quantile(t.frames.total_ms, 0.5, 0));
    };
    for (int turn = 0; turn < kMaxTurns; ++turn) {
        for (std::size_t k = 0; k < count; ++k) {
            const auto i = std::size_t(in_turn(turn, int(k), int(count)));
            burst(i, times[i]);
        }
        if (std::ranges::all_of(times, settled)) break;
    }
    return times;
}

ShadowTime measure_shadow_time(Measurer& measurer, const Scene& scene, const Settings& settings,
                               const std::stop_token& stop) {
    const std::vector<TurnTimes> times = time_in_turns(1, [&](std::size_t, TurnTimes& to) {
        to.shadow.add(time_shadow(measurer, scene, settings, kBurstPairs, kFrontierCost, &to.frames, stop));
    });
    return summarise_shadow(times.front().shadow);
}

}  // namespace si
