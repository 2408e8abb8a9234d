// The editor's search for what the scene advises, and its autopilot.
#pragma once

#include <variant>

#include "app/editor/search.h"
#include "renderer/measure/autopilot.h"
#include "ui/state/editor_ui.h"

namespace si {

struct AdviceFound {
    std::variant<AdviceReport, AutopilotResult> what;
    std::vector<std::pair<std::string, std::string>> changes;  ///< of the autopilot
    std::uint64_t scene = 0;
    Settings settings;  ///< that it is about
    int width = 0, height = 0;
};

class EditorAdvice : public EditorSearch<AdviceFound> {
public:
    EditorAdvice() : EditorSearch("The search for advice was cancelled") {}
    /// In place of what is under way.
    void start(const Scene& scene, const Settings& settings, int width, int height, const AdviceRequest& request);
    /// @param scene Scene::id @param settings of the editor, which what was found may no longer be about
    void fill(AdvicePanelFacts& shown, std::uint64_t scene, const Settings& settings, int width, int height) const;
};

}  // namespace si
