// The editor's search for what puts wrong pixels right: of the picture, and of the probed pixel.
#pragma once

#include "app/editor/search.h"
#include "renderer/measure/cures.h"
#include "ui/state/editor_ui.h"

namespace si {

struct FixOutcome {
    FixTable table;
    std::string problem;  ///< why there is no table
    std::uint64_t scene = 0;
    Settings settings;  ///< that it is about
    int width = 0, height = 0;
    std::optional<glm::ivec2> pixel;
};

class EditorFixes : public EditorSearch<FixOutcome> {
public:
    EditorFixes() : EditorSearch("The search for cures was cancelled") {}
    /// In place of a search that is under way. @param pixel that the table is to speak of, or none: of the picture
    /// @param own a change that is tried besides, such as a dossier's remedy
    void start(const Scene& scene, const Settings& settings, int width, int height, std::optional<glm::ivec2> pixel,
               std::vector<FixCandidate> own);
    void forget() { found_.reset(); }
    /// @param scene Scene::id @param settings of the editor, which the table may no longer be about, nor about the
    /// picture's size
    FixSearch facts(std::uint64_t scene, const Settings& settings, int width, int height) const;

private:
    FixOutcome about_;  ///< what is searched for, and not yet what was found
};

}  // namespace si
