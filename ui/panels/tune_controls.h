// The button that finds the least bias, its limits, and how far a search is.
#pragma once

#include "ui/panels/tune.h"

namespace si {

/// @param settings that a click on a row changes @param ready there is a picture to judge
void draw_tune_controls(TunePanel& panel, Settings& settings, const TuneShown& shown, bool ready, TuneActions& actions);

}  // namespace si
