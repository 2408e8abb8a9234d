// Range of the map viewer's greys as text with units.
#pragma once

#include <string>

#include "renderer/frame/frame.h"

namespace si {

/// Formats the depth or moment for one grey of the map viewer, with its unit. A depth is in metres along the light's
/// axis, after the stored depth where the viewer shows stored depths: "12.5 m", "0.831 (12.5 m)". A moment has no unit:
/// "0.31".
/// @param value in the unit of view.map_black
std::string grey_value_text(const ViewSettings& view, const FrameResult& frame, double value);

/// Formats the values that the map viewer shows as black and as white: "contrast from 2.1 m (black) to 18 m (white),
/// fitted to the stored depths".
std::string grey_range_text(const ViewSettings& view, const FrameResult& frame);

}  // namespace si
