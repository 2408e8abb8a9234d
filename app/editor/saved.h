// The editor's measurement of what savings are worth, in the background.
#pragma once

#include "app/editor/search.h"
#include "renderer/measure/saved.h"
#include "ui/state/editor_ui.h"

namespace si {

struct SavedOutcome {
    SavedTimes times;
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;
    int width = 0, height = 0;
};

class EditorSaved : public EditorSearch<SavedOutcome> {
public:
    EditorSaved() : EditorSearch("Measuring what is saved was cancelled") {}
    /// In place of what is under way. @param request of the frame shown
    void start(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// What was measured of this scene, and whether the settings and the picture's size are still those.
    void fill(EffectsFacts& shown, std::uint64_t scene, const Settings& settings, int width, int height) const;
};

}  // namespace si
