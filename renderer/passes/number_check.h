// Search for invalid numbers in matrices and uniform blocks.
#pragma once

#include "renderer/frame/state.h"

namespace si {

/// Searches the camera's, lights' and objects' matrices and blocks for NaN and infinity.
/// @param[in,out] health receives the findings
void check_matrices_and_blocks(const FrameState& f, NumericHealth& health);

}  // namespace si
