// Background search for fixes: changes of settings that make wrong pixels right, of the picture or of one pixel.
#pragma once

#include "app/editor/search.h"
#include "renderer/advise/fixes.h"
#include "ui/state/editor_ui.h"

namespace si {

/// Result of a finished search for fixes, with the settings and pixel that it is about.
struct FixesFound {
    FixTable table;
    std::string problem;      ///< why there is no table
    std::uint64_t scene = 0;  ///< Scene::id
    Settings settings;        ///< settings that were searched from
    int width = 0, height = 0;
    std::optional<glm::ivec2> pixel;  ///< none: the whole picture
};

/// Background search for fixes of wrong pixels: one at a time, on a thread of its own.
class EditorFixes : public EditorSearch<FixesFound> {
public:
    EditorFixes() : EditorSearch("The search for fixes was cancelled") {}
    /// Starts a search for fixes and cancels the search under way. @param width, height picture, pixels
    /// @param pixel pixel to make right; none: the whole picture
    /// @param own changes to try in addition to the usual ones, such as the fix of a pixel diagnosis
    void start(const Scene& scene, const Settings& settings, int width, int height, std::optional<glm::ivec2> pixel,
               std::vector<FixCandidate> own);
    /// Drops the last table of fixes.
    void forget() { found_.reset(); }
    /// Returns progress and result of the search for fixes. The result is marked as current only if it belongs to this
    /// scene, these settings and this size. @param scene Scene::id @param width, height pixels
    FixSearch facts(std::uint64_t scene, const Settings& settings, int width, int height) const;

private:
    FixesFound about_;  ///< arguments of the search under way
};

}  // namespace si
