// Autopilot: searches combinations of settings for the cheapest within an error limit, or the most accurate within a
// time limit. Error and time are measured.
//
//     AutopilotResult r = run_autopilot(settings, autopilot_axes(settings, facts), {.max_error = 0.01}, meter);
//     if (r.goals_met) use(r.best.settings); else print(r.summary);
#pragma once

#include <optional>

#include "renderer/advise/advice.h"
#include "renderer/measure/axes.h"

namespace si {

/// Goals of an autopilot search: limits on error or frame time, and the metric of the error.
struct AutopilotGoals {
    std::optional<double> max_error, max_ms;   ///< limits; at least one
    const Metric* error = &metrics().front();  ///< metric of max_error; not Better::Neither
    CostCase cost = kDefaultCost;              ///< kind of frames that are timed for max_ms
    double max_seconds = 100;                  ///< duration of the search
    std::size_t max_combinations = 160;        ///< limit of an exhaustive search; above, axes are searched in pairs
};

/// Chooses the settings that the autopilot varies, with their values, from measurements of the frame. The first value
/// of each axis is empty and keeps the present setting.
std::vector<SweepAxis> autopilot_axes(const Settings& settings, const AdviceFacts& facts, int max_resolution = 8192);

/// Removes values that an engine cannot draw, and axes that are left without any. @param engine null: none
void remove_refused(std::vector<SweepAxis>& axes, const EngineProfile* engine, const Settings& base);

/// One combination of settings that the autopilot measured.
struct AutopilotCase {
    std::vector<std::size_t> axis_values;  ///< index of the value on each axis
    Settings settings;
    SettingChanges changes;       ///< of the settings that the search began with
    MeasuredSettings classified;  ///< error and work
    std::optional<double> ms;     ///< frame time; none: not timed, since not needed
    double ms_noise = 0;          ///< half the confidence interval of the frame time
    std::optional<bool> holds;    ///< within the limits; none: not timed, or undecided within noise
};

/// Setting that the autopilot changed, with error and time of its best result if this setting kept its old value.
struct DroppedEffect {
    std::string key, before, now;  ///< setting with its old and new value
    double error = 0;              ///< error with the old value
    CostChange ms;                 ///< frame time that the old value adds
};

/// Result of an autopilot search.
struct AutopilotResult {
    bool goals_met = false;
    AutopilotCase best;  ///< best measured settings within the limits, or those nearest to the limits
    MeasuredSettings before;
    double before_ms = 0;                ///< frame time of the present settings
    std::vector<AutopilotCase> cases;    ///< all measured combinations of settings
    std::vector<DroppedEffect> dropped;  ///< settings that changed, as far as time allowed to measure them
    std::size_t combinations = 0;        ///< number of combinations of the axes
    std::vector<std::string> untried;    ///< sentences about parts of the search that were left out
    std::string summary;                 ///< a sentence
    double seconds = 0;                  ///< duration of the search
    bool stopped = false;                ///< stopped before its end
};

/// Receives the result so far of an autopilot search, after each measured combination.
using AutopilotShow = std::function<void(const AutopilotResult&)>;

/// Searches combinations of settings for the best within the goals: the cheapest under an error limit, else the most
/// accurate under a time limit. Draws nothing; the meter does.
/// @returns the result so far when the meter or the report throws Cancelled after the present settings were measured
AutopilotResult run_autopilot(const Settings& settings, const std::vector<SweepAxis>& axes, const AutopilotGoals& goals,
                              const TrialMeter& meter, const TrialReport& report = {}, const AutopilotShow& show = {});

/// Runs the autopilot with a renderer. Without axes, chooses them by autopilot_axes().
/// @throws Cancelled; Error when there is no light to compare
AutopilotResult run_rendered_autopilot(const SearchTools& tools, const Settings& settings, const AutopilotGoals& goals,
                                       std::vector<SweepAxis> axes = {}, const AutopilotShow& show = {});

}  // namespace si
