// Chooses of which frames a time is.
#pragma once

#include "renderer/measure/frame_costs.h"

namespace si {

/// A combo on a line of its own. @param label before it, such as "Times"
void choose_cost(const char* label, CostCase& cost);

}  // namespace si
