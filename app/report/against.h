// Two pictures of one frame held against each other.
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/settings/settings.h"

namespace si {

/// Settings that draw the frame of `shown` as `other` would: its maps, casters, bias, filter, lights and shading, under
/// the camera, the moment and the views of `shown`.
Settings other_settings(const Settings& shown, const Settings& other);

/// `a` left of the line at `at` (share of the width), `b` right of it, and the line. Both of one size.
ByteImage swiped(const ByteImage& a, const ByteImage& b, double at);
/// `a` and `b` beside each other with a gap.
ByteImage side_by_side(const ByteImage& a, const ByteImage& b);
/// |a - b| of each channel, twice as bright.
ByteImage difference(const ByteImage& a, const ByteImage& b);
/// Mean |a - b| over pixels and colour channels, 0..1.
double mean_difference(const ByteImage& a, const ByteImage& b);

}  // namespace si
