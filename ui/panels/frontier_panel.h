// The panel Frontier: error against cost of measured cases, and the sweep that measures them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/measure/frame_costs.h"
#include "renderer/measure/frontier.h"
#include "renderer/measure/frontier_drawing.h"
#include "renderer/measure/shadow_time.h"

namespace si {

struct Settings;

/// Measured error or cost (time, memory or amount of work) that can be an axis of the frontier plot (error over cost).
/// Smaller values are better.
struct MeasuredColumn {
    std::string key;
    std::string label;
    std::string unit;
    std::string help;
    bool error = false;  ///< an error of the picture; else a cost
};

/// Dot of the frontier plot (error over cost): measured numbers of one case of a sweep (a combination of settings), or
/// of the present settings.
struct MeasuredCase {
    int number = -1;   ///< number in the sweep; -1: the present settings
    std::string name;  ///< "1024 · PCF 3×3"
    std::vector<std::pair<std::string, std::string>>
        settings;                            ///< varied settings, starting values, then settings of this case alone
    std::vector<std::string> setting_texts;  ///< "Kernel: PCF 3×3", one for each setting
    /// Value of each column: distance from the best possible value, or an upper bound where noise hides the value.
    /// Signed metrics keep their sign. NaN: not measured.
    std::vector<double> values;
    std::string failed;  ///< reason why there are no values; empty: it did not fail
};

/// Cases of a sweep (combinations of settings) as dots of the frontier plot, placed by the error and the cost that the
/// user chose as axes.
struct FrontierView {
    /// Dot of one case of a sweep (a combination of settings) in the frontier plot (error over cost).
    struct Mark {
        std::size_t of = 0;  ///< index in the cases
        Dot dot;
        bool on = false;     ///< on the frontier: no case dominates it (dominates())
        bool tied = false;   ///< a better case exists, but within noise
        bool bound = false;  ///< the cost is an upper bound, below its noise
    };
    std::vector<Mark> marks;
    std::optional<Dot> present;  ///< SweepFacts::present
    std::optional<Dot> before;   ///< SweepFacts::before
    FrontierPlot plot;           ///< the dots as data for drawing; PlotCase::of equals Mark::of
    FrontierAdvice advice;       ///< better cases than the present settings, as indices of marks
};

/// Data that the panel Frontier shows: results and progress of the sweep (many measured combinations of settings), and
/// the present settings' numbers.
struct SweepFacts {
    std::vector<MeasuredColumn> columns;
    std::vector<MeasuredCase> cases;  ///< finished and failed
    std::size_t total = 0;            ///< number of cases of the sweep; 0: there is no sweep
    std::size_t failed = 0;
    std::string about;      ///< "stage, 640 x 360 pixels, hard reference; llvmpipe"
    bool software = false;  ///< a CPU rasteriser took the times
    bool other_scene = false;
    std::vector<std::string>
        other_settings;  ///< "Slope bias: 0.5 -> 1 texels": differ from the sweep's, and not varied
    bool running = false;
    bool timing = false;                  ///< the sweep is timing its cases, after errors and costs
    double progress = 0;                  ///< progress of the whole sweep, 0..1
    double seconds_left = 0;              ///< seconds left of the whole sweep; 0: not known yet
    std::string current;                  ///< "round 2 of at most 10: filter.kernel=pcf3"
    std::string problem;                  ///< reason why the last sweep ended early; empty: it did not
    std::optional<MeasuredCase> present;  ///< the shown settings, measured at the sweep's size
    bool measuring_present = false;
    bool present_is_old = false;         ///< its numbers belong to earlier settings, until the shown ones are measured
    std::optional<MeasuredCase> before;  ///< other settings of the same picture: pinned A, else those measured last
    bool before_is_pinned = false;
    std::optional<MeasuredCase> engine;  ///< the chosen engine's defaults on the same picture
    std::string change;  ///< difference from `before` to the present settings: "Kernel: PCF 3×3 → Poisson disk"
    std::string present_problem;
    std::string
        cost;  ///< key of the cost axis; another one than chosen while that has no values; empty: the chosen one
    FrontierView view;  ///< by `cost` and SweepPanel::error
};

/// Setting that a sweep varies, as text that the user types in the panel Frontier: its key and its values.
struct AxisText {
    std::string key, values;
    bool operator==(const AxisText&) const = default;
};

/// State of the panel Frontier: settings that the next sweep varies, its options, and the axes of the plot (error over
/// cost).
struct SweepPanel {
    std::vector<AxisText> axes = {{"filter.kernel", "hard,hw2x2,pcf3,pcf5"}, {"map.resolution", "512:4096:*2"}};
    int width = 480;  ///< pixels of the picture that is measured
    int height = 270;
    bool area = false;                             ///< compares with an area light instead of a point
    CostCase timed = kFrontierCost;                ///< kind of frames that are timed
    bool follow = true;                            ///< measures the present settings while the panel is shown
    std::string cost = "shadow.moving_ms.median";  ///< key of the cost axis
    std::string error = "error.mae";               ///< key of the error axis
    std::optional<int> chosen;                     ///< number of the case that was clicked last
    std::string folder = "sweep";                  ///< folder that results are saved to and opened from
};

/// Request for a sweep (a measurement of many combinations of settings): the varied settings, the picture size and the
/// kind of timed frames.
struct SweepRequest {
    std::vector<std::string> axes;  ///< "KEY=VALUES"
    int width = 0, height = 0;
    bool area = false;
    CostCase timed = kFrontierCost;
};

/// Requests of the panel Frontier, which plots error against cost: start, cancel, save or open a sweep.
struct SweepRequests {
    std::optional<SweepRequest> start_sweep;
    bool cancel_sweep = false;
    std::optional<std::string> save_sweep;  ///< folder to save the sweep to
    std::optional<std::string> open_sweep;  ///< folder to open a sweep from
    bool apply_sweep_base = false;          ///< apply the settings that the sweep's cases share
    bool want_present = false;              ///< measure the present settings
};

/// Draws the panel Frontier: the plot of error over cost, and the controls of the sweep that measures its cases
/// (combinations of settings).
/// @param settings changed by a click on a case @param shown null: there is no sweep, and nothing is measured
void draw_frontier(SweepPanel& panel, Settings& settings, const SweepFacts* shown, SweepRequests& requests);

}  // namespace si
