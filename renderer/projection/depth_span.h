// A part of the depths along an axis.
#pragma once

namespace si {

struct DepthSpan {
    double from_m = 0, to_m = 0;
    bool operator==(const DepthSpan&) const = default;
};

}  // namespace si
