// What would put wrong pixels right, as a table whose rows are applied by a click.
#pragma once

#include "renderer/settings/settings.h"
#include "ui/panels/cures.h"

namespace si {

/// The button that searches, or the search's progress. @param pixel what is to be cured; none: the picture
/// @param ready there is a picture @param wrong there is something to cure
void fixes_button(const FixSearch& search, FixRequests& requests, std::optional<glm::ivec2> pixel, bool ready,
                  bool wrong);
/// What was found for that, if anything was. @param settings that a click on a row changes
void fix_rows_table(Settings& settings, const FixSearch& search, FixRequests& requests,
                    std::optional<glm::ivec2> pixel);

}  // namespace si
