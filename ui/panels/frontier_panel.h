// What the frontier panel shows and asks for: measured cases as plain numbers, and the sweep that a person describes.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/measure/frame_costs.h"
#include "renderer/measure/frontier.h"

namespace si {

/// A measured number. Smaller values are better where it may be an axis of the plot.
struct MeasuredColumn {
    std::string key, label, unit, help;
    bool error = false;  ///< of the picture; else of what it costs
};

/// A case of a sweep, or the present settings.
struct MeasuredCase {
    int number = -1;
    std::string name;                                           ///< "1024 · PCF 3×3"
    std::vector<std::pair<std::string, std::string>> settings;  ///< key and value of what is varied
    std::vector<std::string> setting_texts;                     ///< "Kernel: PCF 3×3", one a setting
    std::vector<double> values;                                 ///< one a column; NaN: not known
    std::string failed;                                         ///< why there are none; empty: it did not fail
};

/// Cases on the two chosen axes.
struct FrontierView {
    struct Mark {
        std::size_t of = 0;  ///< index in the cases
        Dot dot;
        bool on = false;    ///< nothing beats it
        bool tied = false;  ///< within noise of one that is better
    };
    std::vector<Mark> marks;
    std::optional<Dot> present, before;  ///< before: SweepFacts::before
    Advice advice;                       ///< to the present settings; indices of marks
};

struct SweepFacts {
    std::vector<MeasuredColumn> columns;
    std::vector<MeasuredCase> cases;  ///< finished and failed
    std::size_t total = 0;            ///< cases that the sweep has; 0: there is none
    std::size_t failed = 0;
    std::string about;      ///< "stage, 640 x 360 pixels, hard truth; llvmpipe"
    bool software = false;  ///< a CPU rasteriser took the times
    bool other_scene = false;
    std::vector<std::string>
        other_settings;  ///< "Slope bias: 0.5 -> 1 texels": differ from the sweep's, and not varied
    bool running = false, timing = false;
    double progress = 0, seconds_left = 0;  ///< of the whole; 0 s: not known yet
    std::string current;                    ///< "round 2 of at most 10: filter.kernel=pcf3"
    std::string problem;                    ///< why the last sweep ended early
    std::optional<MeasuredCase> present;    ///< the shown settings, measured at the sweep's size
    bool measuring_present = false;
    bool present_is_old = false;  ///< those numbers are of the settings before, while the shown ones are measured
    std::optional<MeasuredCase> before;  ///< other settings of the same picture: pinned A, else those measured last
    bool before_is_pinned = false;
    std::string change;  ///< from those to the present ones: "Kernel: PCF 3×3 → Poisson disk"
    std::string present_problem;
    std::string cost;   ///< column across: the chosen one, or, while that has no values, one that has; empty: chosen
    FrontierView view;  ///< over `cost` and SweepPanel::error
};

/// "KEY=VALUES" as being typed.
struct AxisText {
    std::string key, values;
    bool operator==(const AxisText&) const = default;
};

/// What the panel is set to.
struct SweepPanel {
    std::vector<AxisText> axes = {
        {"filter.kernel", "hard,hw2x2,pcf3,pcf5"}, {"map.resolution", "512:4096:*2"}, {"bias.slope", "0,1,2"}};
    int width = 480, height = 270;  ///< of the picture that is measured, pixels
    bool area = false;              ///< against a light that has its size
    CostCase timed = kDefaultCost;  ///< of which frames times are taken
    bool follow = true;             ///< measure the present settings while the panel is shown
    std::string cost = "time.total_ms.median", error = "error.mae";  ///< keys of the axes
    std::optional<int> chosen;                                       ///< number of the case that was clicked last
    std::string folder = "sweep";                                    ///< that results are saved to and opened from
};

struct SweepRequest {
    std::vector<std::string> axes;  ///< "KEY=VALUES"
    int width = 0, height = 0;
    bool area = false;
    CostCase timed = kDefaultCost;
};

struct SweepRequests {
    std::optional<SweepRequest> start_sweep;
    bool cancel_sweep = false;
    std::optional<std::string> save_sweep, open_sweep;  ///< folders
    bool take_sweep_base = false;                       ///< the settings that the sweep's cases share
    bool want_present = false;                          ///< the present settings are to be measured
};

}  // namespace si
