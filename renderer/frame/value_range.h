// Range of a colour scale, found from the values to show.
#pragma once

#include <optional>

#include "renderer/frame/frame.h"

namespace si {

/// Smallest and largest value of the colour scale with which an overlay is shown.
struct ValueRange {
    float min = 0, max = 1;
    bool operator==(const ValueRange&) const = default;
};

/// Fits the range of a colour scale to overlay values: from the 1st to the 99th percentile of finite values. Extreme
/// pixels therefore do not flatten the scale. The range is at least a thousandth of its largest value wide.
/// @param values RGBA as in FrameResult::overlay: the first channel is the value, the fourth is above 0 where something
/// was drawn
/// @param diverging true: the range is symmetric about zero
/// @return nullopt when no pixel has a value
std::optional<ValueRange> fitted_range(const FloatImage& values, bool diverging);

}  // namespace si
