// Search for the least bias of a frame over all rows of the bias table. Each row is drawn at several strengths, and the
// one with the least score is chosen.
//
//     const FoundBias found = find_least_bias({renderer, scene, 1280, 720, cache}, settings);
//     if (found.best()) settings.bias = found.best()->bias;
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/advise/bias_needs.h"
#include "renderer/advise/trial.h"

namespace si {

/// Largest share of pixels with acne, among those that the error metrics count, at which a frame counts as free of
/// acne.
inline constexpr double kMaxAcneShare = 1e-4;

/// Trial of one bias: error, pixels that lack bias (BiasNeeds), and score of the frame that was drawn with it.
struct BiasTrial {
    ErrorMetrics error;
    BiasNeeds needs;
    /// Error score of the frame; less is better (BiasScore).
    double score = 0;
    /// Returns the number of pixels that are wrong by acne.
    std::size_t acne() const { return error.artefacts[std::size_t(Artefact::Acne)]; }
    /// Returns the number of pixels that are wrong by too much bias. They are false light that a bias or offset lets in
    /// (peter-panning), and false shadow that a normal offset casts (Artefact::OffsetShadow).
    std::size_t lost() const;
    /// Returns true when the share of pixels with acne is within kMaxAcneShare.
    bool has_no_acne() const { return double(acne()) <= kMaxAcneShare * double(error.counted); }
};

/// Error score of a frame, by which biases are compared; less is better. It is the sum of |V - R| over the pixels that
/// the error metrics count, plus 1 for each wrong pixel. V is the visibility in the picture, R that in the reference.
/// The sum leaves out differences within three standard errors of the reference, and pixels within the kernel's reach
/// of a shadow edge.
class BiasScore {
public:
    /// Finds the pixels near shadow edges, whose |V - R| the score leaves out.
    /// @param measured, settings a frame with the scored kernel, map and reference
    BiasScore(const MeasuredError& measured, const Settings& settings);
    /// Returns the error score of a frame that was drawn with another bias; less is better.
    /// @param measured frame, compared with the same reference as the frame given to the constructor
    double compute_score(const MeasuredError& measured) const;

private:
    std::vector<bool> near_edge_;
};

/// Kind of bias (row of the bias table) with its least amounts by theory. A search for the least bias tries multiples
/// of these amounts.
struct BiasStart {
    const Bias* row = nullptr;
    BiasSettings least;  ///< amounts by theory: strength 1
    /// Returns the bias settings at a multiple (`strength`) of the bias by theory. At 0 all amounts are 0.
    BiasSettings at_strength(double strength) const { return scale_bias(least, strength); }
    /// Returns true when this kind of bias has amounts that a strength multiplies.
    bool has_strength() const { return !(at_strength(1) == at_strength(0)); }
};
/// Computes for each kind of bias (row of the bias table) the least amounts by theory, from which a search starts.
/// Empty when no pixel is lit within the map. Kinds that compute the needed bias per pixel, and add bias.constant, get
/// a constant of a quarter of a texel. Leaves out a kind that adds bias at no pixel, whatever its amount, if some
/// pixels need bias. Leaves out polygon offset if the light's maps are imported.
std::vector<BiasStart> bias_starts(const MeasuredError& measured, const Settings& settings, const RasterTraits& driver);

/// Bias settings that a search for the least bias tried, with the error of their frame.
struct TriedBias {
    const Bias* row = nullptr;
    double strength = 1;  ///< multiple of the bias by theory (BiasStart)
    BiasSettings bias;
    BiasTrial trial;
};

/// Row of FoundBias::table(): the best trial of one kind of bias. Marks show the trial with the least score of all, and
/// of all without acne.
struct FoundBiasRow {
    const TriedBias* tried;
    bool least = false;  ///< true: the least score of all trials
    bool clean = false;  ///< true: the least score of all trials without acne
};

/// Result of a search for the least bias: all trials, and best(), the one with the least error score (BiasScore).
struct FoundBias {
    BiasTrial before;                 ///< present bias
    std::vector<TriedBias> tried;     ///< all trials, in the order of the search
    std::optional<double> max_gap_m;  ///< largest lit gap beside casters, 95th percentile, metres; none: any
    bool stopped = false;             ///< true: stopped before all rows were tried
    /// Returns the bias with the least error score among those whose lit gap beside casters (peter-panning, 95th
    /// percentile) is at most max_gap_m wide; null: none. A bias with more wrong pixels than the present bias is left
    /// out, unless every allowed bias has more. Scores closer than a hundredth tie. Then the smaller mean error
    /// decides, then the smaller gap at casters.
    const TriedBias* best() const { return least_score(nullptr, false); }
    /// Returns the bias with the least error score among those without acne, by the rules of best(); null: none.
    const TriedBias* best_without_acne() const { return least_score(nullptr, true); }
    /// Returns the trial with the least error score for each kind of bias (row of the bias table), in the order of the
    /// search. Leaves out kinds without a trial whose gap at casters is within max_gap_m.
    /// @param no_acne true: only trials without acne count
    std::vector<const TriedBias*> best_of_rows(bool no_acne = false) const;
    /// Returns the found biases as a table: the best trial of each kind of bias, and the best trial without acne.
    std::vector<FoundBiasRow> table() const;
    /// Returns the result of the search for the least bias in one sentence.
    /// @param no_acne true: states the best bias among those without acne
    std::string summary(bool no_acne) const;

private:
    /// Returns the tried bias with the least error score among the allowed ones; null: none is allowed. A bias is
    /// allowed if its lit gap beside casters (95th percentile) is at most max_gap_m wide, and the parameters admit it.
    /// A bias with more wrong pixels than the present one is left out, unless every allowed bias has more. Ties of the
    /// score go to the smaller mean error, then to the smaller gap.
    /// @param row admits only this row of the bias table (kind of bias); null: all rows
    /// @param no_acne true: admits only biases without acne
    const TriedBias* least_score(const Bias* row, bool no_acne) const;
};

/// Function that draws a frame under a bias and measures it.
using BiasMeter = std::function<BiasTrial(const BiasSettings&)>;
/// Receives the results so far of a search for the least bias, after each kind of bias (row of the bias table).
using FoundBiasShown = std::function<void(const FoundBias&)>;

/// Searches the least bias among rows of the bias table. For each row it tries powers of two as strengths (multiples of
/// the bias by theory), then strengths between the best of these. Draws by means of `meter`. Stops with the results so
/// far when the meter or the report throws Cancelled after the first trial.
/// @param max_gap_m largest allowed lit gap beside casters, 95th percentile, metres; none: any
FoundBias search_least_bias(const BiasTrial& before, const std::vector<BiasStart>& starts, const BiasMeter& meter,
                            std::optional<double> max_gap_m = {}, const TrialReport& report = {},
                            const FoundBiasShown& shown = {});

/// Searches the least bias of the light that view.light selects, with a renderer. With SearchTools::engine, tries only
/// rows of the bias table that the engine has, and includes the bias that the engine always adds.
/// @throws Cancelled before the first result; Error when the light draws no map
FoundBias find_least_bias(const SearchTools& tools, const Settings& settings, std::optional<double> max_gap_m = {},
                          const FoundBiasShown& shown = {});

/// Returns the reason why a light has no bias to search for, such as that it draws no shadow map; empty: it has one.
/// @param light index of the light in the settings light.*
std::string reason_without_bias(std::span<const FittedLight> lights, int light);

/// Formats the amounts of bias settings for people: "bias.normal 3.1 texels, bias.constant 0.02 texels". A kind of bias
/// that computes the needed amount per pixel is named by its key. "no bias" when there is none.
std::string bias_text(const BiasSettings& bias);

}  // namespace si
