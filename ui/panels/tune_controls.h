// The button that finds the least bias, its limits, and how far a search is.
#pragma once

#include <string>

#include "ui/panels/tune.h"

namespace si {

/// @param settings that a click on a row changes @param why_not nothing can be searched, in words; empty: it can
void draw_tune_controls(TunePanel& panel, Settings& settings, const TunePanelFacts& shown, const std::string& why_not,
                        TuneRequests& requests);

}  // namespace si
