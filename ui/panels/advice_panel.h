// The panel Advice: measured changes of settings that the scene allows, and the autopilot.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "renderer/measure/frame_costs.h"
#include "ui/panels/tune_controls.h"

namespace si {

struct Settings;
struct AdviceReport;
struct AutopilotResult;

/// State of the panel Advice: largest error and longest frame time that the autopilot may reach.
struct AdvicePanel : LimitFields {};

/// Request for a search. With a limit on error or time the autopilot runs, without one the search for advice.
struct AdviceRequest {
    CostCase cost = kDefaultCost;
    std::optional<double> max_error;  ///< largest mean error of visibility
    std::optional<double> max_ms;     ///< longest time of a frame
};

/// Data that the panel Advice shows: progress and last results of advice and autopilot.
struct AdvicePanelFacts {
    std::optional<SearchProgress> advising;      ///< under way
    const AdviceReport* advice = nullptr;        ///< last result for this scene, if of advice
    const AutopilotResult* autopilot = nullptr;  ///< last result for this scene, if of the autopilot
    std::span<const std::pair<std::string, std::string>> autopilot_changes;  ///< setting keys and values
    bool advice_current = false;  ///< the result belongs to the present settings
};

/// Requests of the panel Advice to the application: start or cancel a search.
struct AdviceRequests {
    std::optional<AdviceRequest> find_advice;
    bool cancel_advice = false;
};

/// Draws the panel Advice: measured changes that the scene can do with, and the autopilot.
/// @param ready true: there is a scene to measure
void draw_advice_panel(AdvicePanel& panel, Settings& settings, bool ready, const AdvicePanelFacts& facts,
                       AdviceRequests& requests);

}  // namespace si
