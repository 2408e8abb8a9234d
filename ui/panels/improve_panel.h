// The panel Improve: the least bias, fixes of the picture, advice and the autopilot. Each change is drawn and measured.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "renderer/measure/frame_costs.h"
#include "ui/panels/tune_controls.h"

namespace si {

struct EditorFrame;
struct EditorRequests;
struct EditorState;
struct AdviceReport;
struct AutopilotResult;

/// State of the panel Improve: largest error and longest frame time that the autopilot may reach.
struct ImprovePanel : LimitFields {};

/// Request for a search. With a limit on error or time the autopilot runs, without one the search for advice.
struct AdviceRequest {
    CostCase cost = kDefaultCost;
    std::optional<double> max_error;  ///< largest mean error of visibility
    std::optional<double> max_ms;     ///< longest time of a frame
};

/// Data that the panel Improve shows: progress and last results of advice and autopilot.
struct ImproveFacts {
    std::optional<SearchProgress> advising;      ///< under way
    const AdviceReport* advice = nullptr;        ///< last result for this scene, also while it runs, if of advice
    const AutopilotResult* autopilot = nullptr;  ///< last result for this scene, if of the autopilot
    std::span<const std::pair<std::string, std::string>> autopilot_changes;  ///< setting keys and values
    bool advice_current = false;  ///< the result belongs to the present settings
};

/// Requests of the panel Improve to the application: start or cancel a search.
struct ImproveRequests {
    std::optional<AdviceRequest> find_advice;
    bool cancel_advice = false;
};

/// Draws the panel Improve.
void draw_improve_panel(EditorState& state, const EditorFrame& frame, EditorRequests& requests);

}  // namespace si
