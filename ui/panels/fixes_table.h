// Table of fixes. A click on a row applies it.
#pragma once

#include "renderer/settings/settings.h"
#include "ui/panels/fixes.h"

namespace si {

/// Draws the button that starts the search for fixes, or the progress of the search. @param pixel pixel to make right;
/// none: the picture @param ready there is a picture @param wrong some pixel is wrong
void draw_fixes_button(const FixSearch& search, FixRequests& requests, std::optional<glm::ivec2> pixel, bool ready,
                       bool wrong);
/// Draws the table of fixes found for the pixel or picture, if any. @param settings changed by a click on a row
/// @param pixel pixel that the fixes make right; none: the picture
void draw_fixes_table(Settings& settings, const FixSearch& search, FixRequests& requests,
                      std::optional<glm::ivec2> pixel);

}  // namespace si
