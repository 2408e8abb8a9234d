// What shadow maps are kept in.
#pragma once

#include "renderer/settings/settings.h"

namespace si {

/// Most bytes that maps take with all that is kept of them.
inline constexpr double kMapBudgetBytes = 2.0 * 1024 * 1024 * 1024;

/// Whether a map is a colour image that the fragment shader writes, with a depth buffer beside it while it is drawn.
constexpr bool is_colour(MapFormat map_format) {
    return map_format >= MapFormat::Colour;
}

/// Whether a map holds distances along the light's axis as shares of its range, not depths.
constexpr bool holds_distances(MapFormat map_format) {
    return map_format == MapFormat::Linear || map_format == MapFormat::Linear16;
}

/// Bytes of a texel.
constexpr int texel_bytes(MapFormat map_format) {
    return map_format == MapFormat::D16 || map_format == MapFormat::Linear16 ? 2 : 4;
}

/// Bytes of a texel with the depth buffer beside it.
constexpr int drawn_texel_bytes(MapFormat map_format) {
    return texel_bytes(map_format) + (is_colour(map_format) ? 4 : 0);
}

/// Whether polygon offset moves what is stored.
inline bool offsets_polygons(const Settings& s) {
    return (s.bias.raster_slope != 0 || s.bias.raster_units != 0) && !holds_distances(s.map.format);
}

}  // namespace si
