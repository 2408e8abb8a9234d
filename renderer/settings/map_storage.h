// Storage formats of shadow maps.
#pragma once

#include "renderer/settings/settings.h"

namespace si {

/// Upper limit of the memory for shadow maps with all cached and prepared data, bytes.
inline constexpr double kMapBudgetBytes = 2.0 * 1024 * 1024 * 1024;

/// Returns true when a map of this format is a colour image that the fragment shader writes. Drawing such a map also
/// needs a depth buffer of the same size.
constexpr bool is_colour(MapFormat map_format) {
    return map_format >= MapFormat::Colour;
}

/// Returns true when a map of this format stores distances along the light's axis, as shares of the depth range,
/// instead of depths.
constexpr bool holds_distances(MapFormat map_format) {
    return map_format == MapFormat::Linear || map_format == MapFormat::Linear16;
}

/// Returns the bytes of one texel of a map of this format.
constexpr int texel_bytes(MapFormat map_format) {
    return map_format == MapFormat::D16 || map_format == MapFormat::Linear16 ? 2 : 4;
}

/// Returns the bytes of one texel while the map is drawn: those of the map, and those of the depth buffer that colour
/// formats need.
constexpr int drawn_texel_bytes(MapFormat map_format) {
    return texel_bytes(map_format) + (is_colour(map_format) ? 4 : 0);
}

/// Returns true when polygon offset (bias.raster_*) changes the stored depths.
inline bool offsets_polygons(const Settings& s) {
    return (s.bias.raster_slope != 0 || s.bias.raster_units != 0) && !holds_distances(s.map.format);
}

}  // namespace si
