// Time of the shadows alone: frames with shadows minus the same frames without, drawn alternately.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "renderer/measure/frame_costs.h"
#include "renderer/measure/frontier.h"
#include "renderer/measure/time_sampler.h"

namespace si {

class Measurer;

/// Kind of frames whose shadow time is the cost axis of the frontier: the light moves, so that its maps are drawn.
inline constexpr CostCase kFrontierCost = CostCase::Light;

/// Returns the settings, as keys with values, of the base of all multiples of costs: the hard kernel, 1024 texels.
const std::vector<std::pair<std::string, std::string>>& base_of_costs();
/// Returns the base's name: "Hard (nearest), 1024²".
std::string base_of_costs_name();

/// Returns the settings of the same frame without shadows: every light has the source "none". Shading stays.
Settings without_shadows(Settings settings);

/// Differences of frame times with and without shadows, milliseconds, one per pair of frames.
struct ShadowSamples {
    std::vector<double> moving_ms;       ///< the light of view.light moves: maps, preparation and look-ups
    std::vector<double> still_ms;        ///< the camera moves and maps are kept; as many as `moving_ms`
    std::vector<double> forced_more_ms;  ///< what the frame costs more with all optimisations off; any number
    std::vector<std::size_t> bursts;     ///< index of the first pair of each burst
    /// Appends other differences as bursts of their own.
    void add(const ShadowSamples& more);
};

/// Time of the shadows of one case: distributions over pairs of frames, milliseconds.
struct ShadowTime {
    Spread moving_ms;                                           ///< in a frame in which the light moves
    Spread still_ms;                                            ///< in a frame in which only the camera moves
    std::optional<Spread> forced_ms = {};                       ///< as moving_ms, with all optimisations off
    double of_base = std::numeric_limits<double>::quiet_NaN();  ///< moving_ms over the base's; NaN: within the noise
};

/// Computes the distribution of differences of either sign. @param bursts index of the first value of each burst;
/// empty: one burst
Spread spread_of_differences(std::vector<double> values, std::span<const std::size_t> bursts = {});
/// Returns true when a time does not differ from 0 by more than its noise.
bool below_noise(const Spread& time);
/// Returns the time that a plot shows: the median, or the upper end of its interval when it is below its noise.
double time_or_bound(const Spread& time);
/// Returns the ratio of two times; NaN when one of them is below its noise.
double time_ratio(const Spread& time, const Spread& base);

/// Computes the distributions of the differences. Leaves ShadowTime::of_base unknown.
ShadowTime summarise_shadow(const ShadowSamples& samples);
/// Returns true when further pairs would add little: the interval of the moving light's shadow time is within 5 % of
/// the time or 2 % of the whole frame's. @param frame_ms median of the frame with shadows
bool shadow_settled(const ShadowSamples& samples, double frame_ms);

/// Draws frames of several kinds in turns, and returns the times by kind and round, milliseconds. The order is reversed
/// in every other round, since the first frame of a round finds the caches of the round before.
/// @param draw_ms a function that draws the next frame of a kind, below `kinds`, and returns its milliseconds
std::vector<std::vector<double>> time_rounds(int rounds, int kinds, const std::function<double(int kind)>& draw_ms);
/// Returns the differences a - b of the times of one round each.
std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b);

/// Measures `pairs` pairs of frames with and without shadows with a moving light, as many with a moving camera, and one
/// pair with all optimisations on and off.
/// @param frames receives the frames with shadows of the kind `cost`; null: not wanted @throws Error, Cancelled
ShadowSamples time_shadow(Measurer& measurer, const Scene& scene, const Settings& settings, int pairs, CostCase cost,
                          TimeSamples* frames, const std::stop_token& stop = {});

/// Times of one of several settings that are measured in turns.
struct TurnTimes {
    ShadowSamples shadow;
    TimeSamples frames;  ///< frames with shadows
};

/// Measures several settings in turns, until all have settled or after 8 turns. Every other turn goes in reversed
/// order.
/// @param burst a function that adds a burst of pairs to the times of the settings of an index
std::vector<TurnTimes> time_in_turns(std::size_t count, const std::function<void(std::size_t, TurnTimes&)>& burst);

/// Number of pairs in a burst of time_in_turns().
inline constexpr int kBurstPairs = 3;

/// Measures the shadow time of one set of settings in bursts, until it has settled or after 8 of them.
/// @throws Error, Cancelled
ShadowTime measure_shadow_time(Measurer& measurer, const Scene& scene, const Settings& settings,
                               const std::stop_token& stop = {});

}  // namespace si
