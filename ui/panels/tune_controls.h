// Controls of the search for the smallest bias: buttons, limits, progress, results.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "renderer/measure/frame_costs.h"
#include "renderer/settings/settings.h"

namespace si {

/// Limits of error and frame time for a search, as the user typed them.
struct LimitFields {
    bool bound_error = true;
    bool bound_ms = false;
    double max_error = 0.01;       ///< largest mean error of visibility
    double max_ms = 10;            ///< longest time of a frame
    CostCase cost = kDefaultCost;  ///< kind of frames that are timed
};

/// State of the controls of the bias search.
struct TunePanel : LimitFields {
    bool area = false;  ///< compares with an area light instead of a point
};

/// Progress of a background search or measurement.
struct SearchProgress {
    std::string about;        ///< attempt under way
    double progress = 0;      ///< 0..1
    double seconds_left = 0;  ///< estimated; 0: not known yet
};
/// Formats the progress of a search: "42 %, 12 s left".
std::string progress_text(const SearchProgress& progress);

/// Request for a bias search. Without limits the search finds the bias with the least score.
struct TuneRequest {
    std::optional<double> max_error, max_ms;  ///< limits; with one, kernel and resolution are searched, too
    bool area = false;                        ///< compares with an area light instead of a point
    CostCase cost = kDefaultCost;             ///< kind of frames that max_ms bounds
};

/// Result of a bias search for one row of the bias table.
struct TunedBias {
    std::string name;
    std::string bias_text;
    BiasSettings bias;
    double score = 0;        ///< wrong pixels, plus the error of those that are wrong by less
    std::size_t acne = 0;    ///< pixels of acne
    std::size_t wrong = 0;   ///< wrong pixels
    std::size_t lost = 0;    ///< pixels that the bias itself makes wrong
    double gap_p95_m = 0;    ///< width of the lit strip at contacts, 95th percentile
    double shift_p95_m = 0;  ///< shift of shadow edges, 95th percentile
    bool least = false;      ///< the least score
    bool clean = false;      ///< the least score of those without acne
};

/// Facts of the bias search: progress and last results.
struct TunePanelFacts {
    std::optional<SearchProgress> tuning;    ///< none: not under way
    std::span<const TunedBias> tuned;        ///< results of the last search for this scene, also while it runs
    bool tuned_current = false;              ///< a search from the present settings would give the same
    const Settings* tuned_result = nullptr;  ///< bias, kernel and resolution that the search found; null: none
};

/// Requests of the controls of the bias search.
struct TuneRequests {
    std::optional<TuneRequest> tune;
    bool cancel_tune = false;
    std::optional<BiasSettings> show_bias;  ///< show the present settings with this bias (PictureState::tried)
    bool hide_tried = false;                ///< end that
};

/// Draws the controls of the bias search: buttons, limits, progress and results. A click on a result requests to show
/// it; its button takes it.
/// @param settings changed by a result's button
/// @param tried settings that are shown before they are taken; null: none
/// @param why_not reason why no search is possible; empty: a search is possible
void draw_tune_controls(TunePanel& panel, Settings& settings, const Settings* tried, const TunePanelFacts& shown,
                        const std::string& why_not, TuneRequests& requests);

}  // namespace si
