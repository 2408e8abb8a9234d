// Choice of the kind of frames that are timed.
#pragma once

#include "renderer/measure/frame_costs.h"

namespace si {

/// Draws a combo on a line of its own. @param label text before it, such as "Times"
void choose_cost(const char* label, CostCase& cost);

}  // namespace si
