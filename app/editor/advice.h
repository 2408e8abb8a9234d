// Background search for advice: cheaper settings that the scene allows, and the autopilot.
#pragma once

#include <variant>

#include "app/editor/search.h"
#include "renderer/advise/autopilot.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Result of a finished search for advice, or of the autopilot, with the settings that it is about.
struct AdviceFound {
    std::variant<AdviceReport, AutopilotResult> what;
    std::vector<std::pair<std::string, std::string>> changes;  ///< key and value, of the autopilot
    std::uint64_t scene = 0;                                   ///< Scene::id
    Settings settings;                                         ///< settings that were searched from
    int width = 0, height = 0;                                 ///< pixels of the picture that was measured
};

/// Background search for advice, or run of the autopilot: one at a time, on a thread of its own.
class EditorAdvice : public EditorSearch<AdviceFound> {
public:
    EditorAdvice() : EditorSearch("The search for advice was cancelled") {}
    /// Starts a search for advice (or the autopilot, if `request` has a bound) and cancels the search under way.
    /// @param width, height picture to measure, pixels
    void start(const Scene& scene, const Settings& settings, int width, int height, const AdviceRequest& request);
    /// Writes progress and results of the search for advice into `shown`. They are marked as current only if they
    /// belong to this scene, these settings and this size. @param scene Scene::id @param width, height pixels
    void fill(AdvicePanelFacts& shown, std::uint64_t scene, const Settings& settings, int width, int height) const;
};

}  // namespace si
