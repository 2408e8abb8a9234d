// Range of the map viewer's greys as text with units.
#pragma once

#include <string>

#include "renderer/frame/frame.h"

namespace si {

/// Formats the depth or moment that one grey of the map viewer shows. In the linear view (MapView) it is in metres
/// along the light's axis: "12.5 m". In the raw view, a stored depth is followed by its metres, "0.831 (12.5 m)", and a
/// moment has no unit: "0.31".
/// @param value in the unit of view.map_black
std::string grey_value_text(const ViewSettings& view, const FrameResult& frame, double value);

/// Formats the values that the map viewer shows as black and as white: "contrast from 2.1 m (black) to 18 m (white),
/// fitted to the stored depths".
std::string grey_range_text(const ViewSettings& view, const FrameResult& frame);

}  // namespace si
