// Range of the map viewer's greys as text with units.
#pragma once

#include <string>

#include "renderer/frame/frame.h"

namespace si {

/// Formats a value of the map viewer's grey range with its unit: metres along the axis, and the stored depth where the
/// viewer shows depths as stored: "12.5 m", "0.831 (12.5 m)". A moment's number has no unit: "0.31".
/// @param value as view.map_black counts it
std::string grey_value_text(const ViewSettings& view, const FrameResult& frame, double value);

/// Formats the range of the map viewer's greys of a frame: "contrast from 2.1 m (black) to 18 m (white), fitted to the
/// stored depths".
std::string grey_range_text(const ViewSettings& view, const FrameResult& frame);

}  // namespace si
