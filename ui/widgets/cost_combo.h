// Choice of the kind of frames that are timed.
#pragma once

#include "renderer/measure/frame_costs.h"

namespace si {

/// Draws a combo, on a line of its own, that chooses which kind of frames is timed. The kinds are: every pass drawn,
/// moving camera, moving light.
/// @param label text in front, such as "Times" @param cost changed by the combo
void choose_cost(const char* label, CostCase& cost);

}  // namespace si
