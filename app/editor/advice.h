// The editor's search for what the scene advises, and its autopilot.
#pragma once

#include <variant>

#include "app/base/job.h"
#include "renderer/measure/autopilot.h"
#include "ui/state/editor_ui.h"

namespace si {

class EditorAdvice {
public:
    /// In place of what is under way.
    void start(const Scene& scene, const Settings& settings, int width, int height, const AdviceWish& wish);
    void cancel() { job_.cancel(); }
    bool running() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    void wait() const { job_.wait(); }
    /// Takes what is done. Returns whether there was something; why it failed goes to `problem`.
    bool poll(std::string& problem);
    /// @param scene Scene::id @param settings of the editor, which what was found may no longer be about
    void fill(AdviceShown& shown, std::uint64_t scene, const Settings& settings, int width, int height) const;

private:
    struct Found {
        std::variant<AdviceReport, AutopilotResult> what;
        std::vector<std::pair<std::string, std::string>> changes;  ///< of the autopilot
        std::uint64_t scene = 0;
        Settings settings;  ///< that it is about
        int width = 0, height = 0;
    };
    Job<Found, TuneFacts> job_;
    std::optional<Found> found_;
};

}  // namespace si
