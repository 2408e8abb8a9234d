// List of fixes. A click on one shows it beside the picture; its button applies it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "renderer/settings/settings.h"
#include "ui/panels/tune_controls.h"

namespace si {

struct FixTable;
struct Trial;

/// Request to search for fixes. A fix changes settings so that wrong pixels, whose shadow differs from the ray-traced
/// reference, become right.
struct FixRequest {
    std::optional<glm::ivec2> pixel;  ///< pixel to put right; none: the whole picture
    bool first = false;               ///< stops at the first fix
};

/// State and result of the search for fixes, which are changes of settings that put wrong pixels right.
struct FixSearch {
    std::optional<SearchProgress> running;  ///< none: no search is under way
    const FixTable* table = nullptr;        ///< last result; null: none
    std::optional<glm::ivec2> pixel;        ///< pixel of the last result; none: the picture
    bool current = false;                   ///< the last result is about the present settings
};

/// Requests to the application by the table of fixes (changes of settings): search, cancel, drop the result, show or
/// apply a fix.
struct FixRequests {
    std::optional<FixRequest> find_fixes;  ///< start a search for a pixel or for the picture
    bool cancel_fixes = false;             ///< cancel the search for the picture
    bool forget_fixes = false;             ///< drop the last result of the picture
    bool cancel_pixel_fixes = false;
    bool forget_pixel_fixes = false;
    const Trial* apply_fix = nullptr;  ///< apply this row of a table
    const Trial* show_fix = nullptr;   ///< show this row beside the picture (PictureState::tried)
};

/// Returns the fix (change of settings) that a search found for a pixel under the present settings. Null: there is
/// none, or no search has ended.
/// @param pixel the pixel; none: the whole picture
const Trial* found_fix(const FixSearch& search, std::optional<glm::ivec2> pixel);

/// Draws the button that starts the search for fixes of wrong pixels. While a search runs, draws its progress and a
/// button that cancels it.
/// @param pixel pixel to put right; none: the whole picture @param ready true: there is a picture
/// @param wrong true: some pixel is wrong
void draw_fixes_button(const FixSearch& search, FixRequests& requests, std::optional<glm::ivec2> pixel, bool ready,
                       bool wrong);
/// Draws the list of fixes (changes of settings) found for a pixel or the picture; nothing if there was no search. A
/// click on a row shows its fix beside the picture, or hides it again. The row's button applies the fix.
/// @param settings present settings @param tried settings that are shown for trial; null: none
/// @param pixel the pixel that the fixes put right; none: the whole picture
/// @returns true at a click that hides the shown row
bool draw_fixes_table(const FixSearch& search, const Settings& settings, const Settings* tried, FixRequests& requests,
                      std::optional<glm::ivec2> pixel);

/// Returns true if the settings shown for trial equal the present ones with `changes` applied. Lists of changes use
/// this to mark the row that is shown for trial.
/// @param settings present settings @param tried settings that are shown for trial; null: none
/// @param changes pairs of setting key and value
bool is_tried(const Settings& settings, const Settings* tried,
              std::span<const std::pair<std::string, std::string>> changes);

}  // namespace si
