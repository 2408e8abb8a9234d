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

/// Kind of frames whose shadow time is the cost axis of the frontier plot (error over cost). The light moves, so that
/// its maps are drawn.
inline constexpr CostCase kFrontierCost = CostCase::Light;

/// Returns the settings (key, value) of the base case: the hard kernel in a map of 1024 texels. Reports give the cost
/// of other settings as a multiple of the base case's cost.
const std::vector<std::pair<std::string, std::string>>& base_of_costs();
/// Returns the name of the base case: "Hard (nearest), 1024²". Reports give the cost of other settings as a multiple of
/// the base case's cost.
std::string base_of_costs_name();

/// Returns a copy of the settings in which no light casts shadows (source "none"), with the same shading. Used to time
/// the shadows alone.
Settings without_shadows(Settings settings);

/// Times of the shadows alone, in milliseconds: frames with shadows minus the same frames without, one value per pair.
struct ShadowSamples {
    std::vector<double> moving_ms;       ///< the light of view.light moves: maps, preparation and look-ups
    std::vector<double> still_ms;        ///< the camera moves and maps are cached; may be fewer than `moving_ms`
    std::vector<double> forced_more_ms;  ///< additional time of a frame with all optimisations off
    std::vector<std::size_t> bursts;     ///< index into `moving_ms` of the first pair of each burst
    std::vector<std::size_t> still_bursts = {};  ///< index into `still_ms` of the first pair of each burst
    /// Appends the shadow times of further pairs of frames, one with and one without shadows. Their bursts (runs of
    /// frames without a pause) stay separate.
    void add(const ShadowSamples& more);
};

/// Time of the shadows alone under one set of settings: statistics over pairs of frames, one with and one without
/// shadows. In milliseconds.
struct ShadowTime {
    Spread moving_ms;                                           ///< shadow time while the light moves
    Spread still_ms;                                            ///< shadow time while only the camera moves
    std::optional<Spread> forced_ms = {};                       ///< as moving_ms, optimisations off; none: not timed
    double of_base = std::numeric_limits<double>::quiet_NaN();  ///< moving_ms / that of the base; NaN: within noise
};

/// Computes the statistics of time differences, which may be negative.
/// @param bursts index of the first value of each burst (run of frames without a pause); empty: one burst
Spread spread_of_differences(std::vector<double> values, std::span<const std::size_t> bursts = {});
/// Returns true when a measured time does not differ from 0 by more than its noise.
bool below_noise(const Spread& time);
/// Returns the value at which a plot shows a measured time. It is the median, or the upper end of the confidence
/// interval when the time is below its noise.
double time_or_bound(const Spread& time);
/// Returns the median of `time` divided by the median of `base`; NaN when one of the times is below its noise.
double time_ratio(const Spread& time, const Spread& base);

/// Computes the statistics of measured shadow times. ShadowTime::of_base (the time as a multiple of the base case's)
/// stays NaN; the caller computes it by time_ratio().
ShadowTime summarise_shadow(const ShadowSamples& samples);
/// Returns true once the shadow time under a moving light is measured precisely enough. After at least kMinBursts
/// bursts of frames, half the confidence interval must be within 5 % of the shadow time or 2 % of the frame time.
/// @param frame_ms median time of the frame with shadows
bool shadow_settled(const ShadowSamples& samples, double frame_ms);

/// Draws frames of several kinds alternately, for fair timing, and returns the milliseconds by kind and round. Every
/// other round has the reversed order, since the first frame of a round finds the caches of the round before.
/// @param rounds number of frames of each kind @param kinds number of kinds
/// @param draw_ms a function that draws the next frame of a kind, 0 to kinds - 1, and returns its milliseconds
std::vector<std::vector<double>> time_rounds(int rounds, int kinds, const std::function<double(int kind)>& draw_ms);
/// Returns the differences a[i] - b[i] of two lists of frame times, one for each round that both lists have.
std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b);

/// Kinds of frames that time_shadow() draws: those of all three times of ShadowSamples, or those under a moving light.
enum class ShadowFrames { All, MovingLight };

/// Times frames with and without shadows: `pairs` pairs with a moving light. With ShadowFrames::All, `pairs` pairs with
/// a moving camera follow, and one pair that compares all optimisations on with all off.
/// @param frames receives the frames with shadows of the kind `cost`; null: not wanted
/// @param which ShadowFrames::MovingLight only if `cost` is CostCase::Light @throws Error, Cancelled
ShadowSamples time_shadow(Measurer& measurer, const Scene& scene, const Settings& settings, int pairs, CostCase cost,
                          TimeSamples* frames, const std::stop_token& stop = {},
                          ShadowFrames which = ShadowFrames::All);

/// Frame times and shadow times under one of several settings that are measured alternately.
struct TurnTimes {
    ShadowSamples shadow;
    TimeSamples frames;  ///< frames with shadows
};

/// Measures the shadow times of several settings alternately, one burst of frames at a time. Ends when all times have
/// settled (shadow_settled()) or after 8 turns. Every other turn has the reversed order.
/// @param count number of settings
/// @param burst a function burst(i, times) that measures one burst under the settings number i, 0 to count - 1, and
/// appends the measured times to `times`
std::vector<TurnTimes> time_in_turns(std::size_t count, const std::function<void(std::size_t, TurnTimes&)>& burst);

/// Number of pairs of frames, with and without shadows, in one burst (run without a pause) of measure_shadow_time().
inline constexpr int kBurstPairs = 3;

/// Measures the shadow time of one set of settings in bursts, until it has settled (shadow_settled()) or after 8
/// bursts.
/// @throws Error, Cancelled
ShadowTime measure_shadow_time(Measurer& measurer, const Scene& scene, const Settings& settings,
                               const std::stop_token& stop = {});

}  // namespace si
