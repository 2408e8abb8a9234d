// Computes the metrics that the claims of guided presets (assets/presets) name.
#pragma once

#include <string>

#include "tests/support/guided.h"

namespace si::test {

/// Returns the value of the metric that a claim's subject names, or of a sum of metrics "A + B".
/// @param drawing drawing of the claim's subject
/// @param than drawing of the claim's other side, for metrics that compare two drawings; nullptr: the claim has none
/// @throws Error if there is no metric of that name
double claim_metric(const ClaimSubject& subject, const GuidedDrawing& drawing, const GuidedDrawing* than);

/// Returns whether a metric compares the two drawings of a claim. A claim with such a metric compares its value with a
/// number only.
bool compares_drawings(const std::string& metric);

}  // namespace si::test
