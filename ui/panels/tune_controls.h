// Parts of the search for the smallest bias: limits, progress, results.
#pragma once

#include <optional>
#include <string>

#include "renderer/measure/frame_costs.h"
#include "renderer/settings/settings.h"

namespace si {

struct FoundBias;

/// Request to search for better settings: for the least bias, or for advice on all settings. A limit of error or frame
/// time changes both searches. The search for the least bias then also tries kernels and resolutions. The search for
/// advice is then replaced by the autopilot, which looks for the best combination of settings within the limits. No
/// search changes the settings by itself.
struct SearchRequest {
    std::optional<double> max_error;  ///< largest mean error of visibility; none: no limit
    std::optional<double> max_ms;     ///< longest time of a frame, milliseconds; none: no limit
    bool area = false;                ///< compares with an area light instead of a point
    CostCase cost = kDefaultCost;     ///< kind of frames that are timed
};

/// Limits of error and frame time for a search, as the user typed them.
struct LimitFields {
    bool bound_error = true;
    bool bound_ms = false;
    double max_error = 0.01;       ///< largest mean error of visibility
    double max_ms = 10;            ///< longest time of a frame, milliseconds
    CostCase cost = kDefaultCost;  ///< kind of frames that are timed
    /// Returns true when a limit is switched on.
    bool any() const { return bound_error || bound_ms; }
    /// Returns a request for a search within those limits of error and frame time that are switched on.
    SearchRequest request() const;
};
/// Draws the checkbox and the number field of one limit of a search. Typing a number switches the limit on.
/// @param about tooltip @param on true: the limit counts @param value the limit @param least smallest value
/// @param format printf format of the number
void limit_field(const char* label, const char* about, bool& on, double& value, double least, const char* format);

/// Progress of a search or measurement that runs in the background.
struct SearchProgress {
    std::string about;        ///< attempt under way
    double progress = 0;      ///< 0..1
    double seconds_left = 0;  ///< estimated; 0: not known yet
};
/// Formats the progress of a search in the background: "42 %, 12 s left".
std::string progress_text(const SearchProgress& progress);

/// Data that panels show about the search for the least bias: progress and last results.
struct TunePanelFacts {
    std::optional<SearchProgress> tuning;    ///< none: not under way
    const FoundBias* tuned = nullptr;        ///< last result for this scene, also while the search runs; null: none
    bool tuned_current = false;              ///< a search from the present settings would give the same
    const Settings* tuned_result = nullptr;  ///< bias, kernel and resolution that the search found; null: none
};

/// Requests to the application about the search for the least bias: start, cancel, show a bias for trial.
struct TuneRequests {
    std::optional<SearchRequest> tune;
    bool cancel_tune = false;
    std::optional<BiasSettings> show_bias;  ///< show the present settings with this bias (PictureState::tried)
    bool hide_tried = false;                ///< end the display of settings for trial
};

/// Draws the progress of the search for the least bias, with a button that cancels it.
void draw_tune_progress(const SearchProgress& progress, TuneRequests& requests);
/// Draws the table of biases that the search for the least bias has tried. A click on a row shows its bias beside the
/// picture, or hides it again. The row's button sets the bias.
/// @param settings changed by a row's button @param tried settings that are shown for trial; null: none
void draw_biases_table(const TunePanelFacts& shown, Settings& settings, const Settings* tried, TuneRequests& requests);
/// Draws the button that sets the kernel, resolution and bias that a search within limits of error or frame time has
/// found. Draws nothing if `settings` already have this kernel and resolution, or the result belongs to other settings.
void draw_tuned_result(const TunePanelFacts& shown, Settings& settings, TuneRequests& requests);

}  // namespace si
