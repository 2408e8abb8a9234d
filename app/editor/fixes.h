// Background search for fixes: changes of settings that make wrong pixels right, of the picture or of one pixel.
#pragma once

#include "app/editor/search.h"
#include "renderer/advise/fixes.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Result of a finished search.
struct FixesFound {
    FixTable table;
    std::string problem;      ///< why there is no table
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;        ///< settings that were searched from
    int width = 0, height = 0;
    std::optional<glm::ivec2> pixel;  ///< none: the whole picture
};

/// One search for fixes at a time, on a thread of its own.
class EditorFixes : public EditorSearch<FixesFound> {
public:
    EditorFixes() : EditorSearch("The search for fixes was cancelled") {}
    /// Starts a search and cancels the one under way. @param pixel to make right; none: the whole picture
    /// @param own changes to try besides the usual ones, such as the fix of a pixel diagnosis
    void start(const Scene& scene, const Settings& settings, int width, int height, std::optional<glm::ivec2> pixel,
               std::vector<FixCandidate> own);
    /// Drops the last result.
    void forget() { found_.reset(); }
    /// Returns progress and result, marked as current only if it is about these arguments. @param scene Scene::id
    FixSearch facts(std::uint64_t scene, const Settings& settings, int width, int height) const;

private:
    FixesFound about_;  ///< arguments of the search under way
};

}  // namespace si
