// Matrices and blocks searched for numbers that are none.
#pragma once

#include "renderer/frame/state.h"

namespace si {

/// Adds what is found in the camera's, the lights' and the objects' to `health`.
void check_matrices_and_blocks(const FrameState& f, NumericHealth& health);

}  // namespace si
