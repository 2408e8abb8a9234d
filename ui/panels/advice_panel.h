// What the scene advises, and the autopilot: what the panel is set to, what was found, what it wishes for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "renderer/measure/frame_costs.h"
#include "ui/panels/tune.h"

namespace si {

struct Settings;
struct AdviceReport;     // renderer/advise/advice.h
struct AutopilotResult;  // renderer/advise/autopilot.h

struct AdvicePanel {
    CostCase cost = kDefaultCost;  ///< of which frames times are
    bool bound_error = true, bound_ms = false;
    double most_error = 0.01, most_ms = 10;
};

/// Without bounds what the scene advises; with one the autopilot.
struct AdviceRequest {
    CostCase cost = kDefaultCost;
    std::optional<double> most_error, most_ms;
};

struct AdvicePanelFacts {
    std::optional<SearchProgress> advising;                                  ///< under way
    const AdviceReport* advice = nullptr;                                    ///< found last, of this scene
    const AutopilotResult* autopilot = nullptr;                              ///< the same; one of the two
    std::span<const std::pair<std::string, std::string>> autopilot_changes;  ///< key and value
    bool advice_current = false;                                             ///< of the present settings
};

struct AdviceRequests {
    std::optional<AdviceRequest> find_advice;
    bool cancel_advice = false;
};

/// Draws the panel Advice: measured changes that the scene can do with, and the autopilot.
/// @param ready there is a scene to measure
void draw_advice_panel(AdvicePanel& panel, Settings& settings, bool ready, const AdvicePanelFacts& facts,
                       AdviceRequests& requests);

}  // namespace si
