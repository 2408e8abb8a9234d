// Metrics that the claims of guided presets (assets/presets) measure, by name.
#pragma once

#include <string>

#include "tests/support/guided.h"

namespace si::test {

/// Returns the value of a metric, or of the sum "A + B".
/// @param than drawing of the claim's other side, for metrics that compare two drawings; nullptr: the claim has none
/// @throws Error when there is no metric of that name
double claim_metric(const ClaimSubject& subject, const Guided& drawing, const Guided* than);

/// Returns whether the metric compares the two drawings of a claim, which then compares its value with a number alone.
bool compares_drawings(const std::string& metric);

}  // namespace si::test
