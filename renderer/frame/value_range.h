// A colour scale's range from the values it is to show.
#pragma once

#include <optional>

#include "renderer/frame/frame.h"

namespace si {

struct ValueRange {
    float min = 0, max = 1;
    bool operator==(const ValueRange&) const = default;
};

/// From the 1st to the 99th percentile of the finite values where something was drawn, so that a few extreme pixels
/// do not flatten the scale. At least a thousandth of its largest value wide.
/// @param values RGBA as FrameResult::overlay has them: the value in x, a > 0 where drawn
/// @param diverging the scale is centred on zero: the range is symmetric
/// @return nothing when no pixel has a value
std::optional<ValueRange> fitted_range(const FloatImage& values, bool diverging);

}  // namespace si
