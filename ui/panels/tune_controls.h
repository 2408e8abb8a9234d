// Controls of the search for the smallest bias: buttons, limits, progress, results.
#pragma once

#include <string>

#include "ui/panels/tune.h"

namespace si {

/// Draws the controls of the bias search: buttons, limits, progress and results. @param settings changed by a click on
/// a result @param why_not reason why no search is possible; empty: a search is possible
void draw_tune_controls(TunePanel& panel, Settings& settings, const TunePanelFacts& shown, const std::string& why_not,
                        TuneRequests& requests);

}  // namespace si
