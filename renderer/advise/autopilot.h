// Autopilot: searches combinations of settings for the cheapest within an error limit, or the most accurate within a
// time limit. Error and time are measured.
//
//     AutopilotResult r = run_autopilot(settings, autopilot_axes(settings, facts, 4096), {.max_error = 0.01}, meter);
//     if (r.goals_met) use(r.best.settings); else print(r.summary);
#pragma once

#include <optional>

#include "renderer/advise/advice.h"
#include "renderer/measure/axes.h"

namespace si {

/// Goals of an autopilot search for the best combination of shadow settings: a limit on error or frame time, the error
/// metric, and limits on the search itself.
struct AutopilotGoals {
    std::optional<double> max_error, max_ms;   ///< limits; at least one
    const Metric* error = &metrics().front();  ///< metric of max_error; not Better::Neither
    CostCase cost = kDefaultCost;              ///< kind of frames that are timed for max_ms
    double max_seconds = 100;                  ///< duration of the search
    std::size_t max_combinations = 160;        ///< largest number that is searched whole; above, axes are paired
};

/// Chooses the settings that the autopilot (search for the best combination of settings) varies, and the values that it
/// tries, from measurements of the frame. Each axis is one setting. Its first value is empty and keeps the present
/// setting.
/// @param max_resolution largest map resolution that the driver supports, texels per side. Resolutions above 4096 are
/// never tried
std::vector<SweepAxis> autopilot_axes(const Settings& settings, const AdviceFacts& facts, int max_resolution);

/// Removes the values that an engine cannot draw from the axes of a settings search, then the axes without any value.
/// @param engine engine that is to draw the found settings; null: nothing is removed
/// @param base present settings, in which each value is tested alone
void remove_refused(std::vector<SweepAxis>& axes, const EngineProfile* engine, const Settings& base);

/// One combination of settings that the autopilot (search for the best settings) tried, with its error and frame time.
struct AutopilotCase {
    std::vector<std::size_t> axis_values;  ///< index of the value on each axis
    Settings settings;
    SettingChanges changes;       ///< changes from the settings with which the search began
    MeasuredSettings classified;  ///< error and work
    std::optional<double> ms;     ///< frame time; none: not timed, since not needed
    double ms_noise = 0;          ///< half the confidence interval of the frame time
    std::optional<bool> holds;    ///< true: within the limits; none: not timed, or undecided within noise
};

/// Contribution of one setting to the autopilot's result: error and frame time of the best settings found, with only
/// this setting put back to its old value.
struct SettingContribution {
    std::string key, before, now;  ///< setting with its old and new value
    double error = 0;              ///< error with the old value
    CostChange ms;                 ///< frame time that the old value adds
};

/// Result of an autopilot search: the best settings found, and all combinations that were measured.
struct AutopilotResult {
    bool goals_met = false;
    AutopilotCase best;  ///< best measured settings within the limits, or those nearest to the limits
    MeasuredSettings before;
    double before_ms = 0;                      ///< frame time of the present settings
    std::vector<AutopilotCase> cases;          ///< all measured combinations of settings
    std::vector<SettingContribution> dropped;  ///< contributions of changed settings, as far as time allowed
    std::size_t combinations = 0;              ///< number of combinations of the axes
    std::vector<std::string> untried;          ///< sentences about parts of the search that were left out
    std::string summary;                       ///< a sentence
    double seconds = 0;                        ///< duration of the search
    bool stopped = false;                      ///< stopped before its end
};

/// Receives the result so far of an autopilot search, after each measured combination.
using AutopilotShow = std::function<void(const AutopilotResult&)>;

/// Searches combinations of settings for the best within the goals: the cheapest under an error limit, or without it
/// the most accurate under a time limit. Draws and times by means of `meter`. Settings that act only while maps are
/// drawn are not varied on imported maps.
/// @returns the result so far when the meter or the report throws Cancelled after the present settings were measured
AutopilotResult run_autopilot(const Settings& settings, const std::vector<SweepAxis>& axes, const AutopilotGoals& goals,
                              const TrialMeter& meter, const TrialReport& report = {}, const AutopilotShow& show = {});

/// Runs the autopilot, the search for the best combination of settings, with a renderer. Without axes (settings to
/// vary), chooses them by autopilot_axes().
/// @throws Cancelled; Error when there is no light to compare
AutopilotResult run_rendered_autopilot(const SearchTools& tools, const Settings& settings, const AutopilotGoals& goals,
                                       std::vector<SweepAxis> axes = {}, const AutopilotShow& show = {});

}  // namespace si
