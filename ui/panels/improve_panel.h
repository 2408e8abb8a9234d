// The panel Improve: one place for all searches. Each tried change is drawn and measured, and can be seen beside the
// picture before it is applied.
#pragma once

#include <optional>

#include "renderer/base/index_of.h"
#include "ui/panels/tune_controls.h"

namespace si {

struct EditorFrame;
struct EditorRequests;
struct EditorState;
struct AdviceReport;
struct AutopilotResult;
struct Waste;

/// Aim of the panel Improve: put the probed pixel right; put all wrong pixels right; make the same picture cheaper;
/// find the most accurate settings within limits of error and time.
enum class ImproveMode { Pixel, Picture, Cheaper, Limits };
inline constexpr int kImproveModes = index_of(ImproveMode::Limits) + 1;

/// State of the panel Improve, where the user starts searches for better settings: the chosen aim, and limits of error
/// and time.
struct ImprovePanel : LimitFields {
    ImproveMode mode = ImproveMode::Picture;
    bool area = false;  ///< the search for kernel and resolution compares with an area light instead of a point
};

/// Data that the panel Improve shows: progress and last results of its searches. These search for advice (ranked
/// changes of settings), the best settings within limits (autopilot), and waste (work that changes no byte of the
/// picture).
struct ImproveFacts {
    std::optional<SearchProgress> advising;      ///< under way
    const AdviceReport* advice = nullptr;        ///< result for this scene, so far or final; null: none, or autopilot's
    const AutopilotResult* autopilot = nullptr;  ///< result for this scene, so far or final; null: none, or advice's
    bool advice_current = false;                 ///< the result belongs to the present settings
    std::optional<SearchProgress> wasting;       ///< the search for waste, under way
    const Waste* waste = nullptr;                ///< waste in this scene, found so far or in all; null: not searched
    bool waste_current = false;                  ///< `waste` belongs to the present settings
};

/// Requests of the panel Improve to the application: start or cancel a search.
struct ImproveRequests {
    std::optional<SearchRequest> find_advice;  ///< start the autopilot if a limit is set, else advice
    bool cancel_advice = false;
    bool find_waste = false;
    bool cancel_waste = false;
};

/// Brings the panel Improve, which searches for better settings, to the front and chooses the aim of the search.
void open_improve(EditorState& state, ImproveMode mode);
/// Draws the panel Improve, which searches for settings that are more accurate or cheaper.
void draw_improve_panel(EditorState& state, const EditorFrame& frame, EditorRequests& requests);

}  // namespace si
