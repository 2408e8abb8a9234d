// An interval of depths along an axis.
#pragma once

namespace si {

/// Interval of depths along a view's axis, metres.
struct DepthSpan {
    double from_m = 0, to_m = 0;
    bool operator==(const DepthSpan&) const = default;
};

}  // namespace si
