// The editor's search for what puts wrong pixels right: of the picture, and of the probed pixel.
#pragma once

#include "app/base/job.h"
#include "renderer/measure/cures.h"
#include "ui/state/editor_ui.h"

namespace si {

struct CureOutcome {
    CureTable table;
    std::string problem;  ///< why there is no table
    std::uint64_t scene = 0;
    Settings settings;  ///< that it is about
    int width = 0, height = 0;
    std::optional<glm::ivec2> pixel;
};

class EditorCures {
public:
    /// In place of a search that is under way. @param pixel that the table is to speak of, or none: of the picture
    /// @param own a change that is tried besides, such as a dossier's remedy
    void start(const Scene& scene, const Settings& settings, int width, int height, std::optional<glm::ivec2> pixel,
               std::vector<CureIdea> own);
    void cancel() { job_.cancel(); }
    void forget() { found_.reset(); }
    bool running() const { return job_.busy(); }
    bool moved() const { return job_.moved(); }
    void wait() const { job_.wait(); }
    /// Takes what is done. Returns whether there was something; why it failed goes to `problem`.
    bool poll(std::string& problem);
    /// @param scene Scene::id @param settings of the editor, which the table may no longer be about, nor about the
    /// picture's size
    CureSearch facts(std::uint64_t scene, const Settings& settings, int width, int height) const;

private:
    CureOutcome about_;  ///< what is searched for, and not yet what was found
    Job<CureOutcome, TuneFacts> job_;
    std::optional<CureOutcome> found_;
};

}  // namespace si
