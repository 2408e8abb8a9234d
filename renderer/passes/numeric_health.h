// What the search for numbers that are none found, back from the GPU.
#pragma once

#include <memory>

#include "renderer/frame/numeric_health.h"
#include "renderer/frame/state.h"

namespace si {

/// Of the frame that ran the pass last. Null: the driver is not through with it. @param wait for it
std::shared_ptr<const NumericHealth> read_numeric_health(Resources& resources, bool wait);

}  // namespace si
