// The editor's measurement of what savings are worth, in the background.
#pragma once

#include <memory>

#include "app/base/job.h"
#include "renderer/measure/saved.h"
#include "ui/state/editor_ui.h"

namespace si {

struct SavedOutcome {
    SavedTimes times;
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;
    int width = 0, height = 0;
};

class EditorSaved {
public:
    /// In place of what is under way. @param request of the frame shown
    void start(const Scene& scene, const Settings& settings, const FrameRequest& request);
    void cancel() { job_.cancel(); }
    bool running() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    void wait() const { job_.wait(); }
    /// Takes what is done. Returns whether there was something; why it failed goes to `problem`.
    bool poll(std::string& problem);
    /// What was measured of this scene, and whether the settings and the picture's size are still those.
    void fill(EffectsShown& shown, std::uint64_t scene, const Settings& settings, int width, int height) const;

private:
    Job<SavedOutcome, TuneFacts> job_;
    std::optional<SavedOutcome> found_;
};

}  // namespace si
