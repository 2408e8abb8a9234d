// The panel Improve: the least bias, fixes of the picture, advice, the autopilot and wasted work. Each change is
// drawn and measured.
#pragma once

#include <optional>

#include "ui/panels/tune_controls.h"

namespace si {

struct EditorFrame;
struct EditorRequests;
struct EditorState;
struct AdviceReport;
struct AutopilotResult;
struct Waste;

/// State of the panel Improve: largest error and longest frame time that the autopilot may reach.
struct ImprovePanel : LimitFields {};

/// Data that the panel Improve shows: progress and last results of advice, autopilot and the search
/// for waste.
struct ImproveFacts {
    std::optional<SearchProgress> advising;      ///< under way
    const AdviceReport* advice = nullptr;        ///< last result for this scene, also while it runs, if of advice
    const AutopilotResult* autopilot = nullptr;  ///< last result for this scene, if of the autopilot
    bool advice_current = false;                 ///< the result belongs to the present settings
    std::optional<SearchProgress> wasting;       ///< the search for waste, under way
    const Waste* waste = nullptr;                ///< its last result for this scene, also while it runs; null: none
    bool waste_current = false;                  ///< that result belongs to the present settings
};

/// Requests of the panel Improve to the application: start or cancel a search.
struct ImproveRequests {
    std::optional<SearchRequest> find_advice;  ///< with a limit of the autopilot, without one of advice
    bool cancel_advice = false;
    bool find_waste = false;
    bool cancel_waste = false;
};

/// Draws the panel Improve.
void draw_improve_panel(EditorState& state, const EditorFrame& frame, EditorRequests& requests);

}  // namespace si
