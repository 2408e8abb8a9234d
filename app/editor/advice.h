// Background search for advice: changes of settings that a scene can do with, and the autopilot.
#pragma once

#include <variant>

#include "app/editor/search.h"
#include "renderer/advise/autopilot.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Result of a finished search.
struct AdviceFound {
    std::variant<AdviceReport, AutopilotResult> what;
    std::vector<std::pair<std::string, std::string>> changes;  ///< key and value, of the autopilot
    std::uint64_t scene = 0;                                   ///< Scene::id
    Settings settings;                                         ///< settings that were searched from
    int width = 0, height = 0;                                 ///< pixels of the picture that was measured
};

/// One search for advice at a time, on a thread of its own.
class EditorAdvice : public EditorSearch<AdviceFound> {
public:
    EditorAdvice() : EditorSearch("The search for advice was cancelled") {}
    /// Starts a search and cancels the one under way.
    void start(const Scene& scene, const Settings& settings, int width, int height, const AdviceRequest& request);
    /// Writes progress and results into `shown`, marked as current only if they are about these arguments.
    /// @param scene Scene::id
    void fill(AdvicePanelFacts& shown, std::uint64_t scene, const Settings& settings, int width, int height) const;
};

}  // namespace si
