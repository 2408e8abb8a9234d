// What bias depends on of the driver: sub-pixel bits, and what glPolygonOffset is worth, which OpenGL leaves open.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/settings/settings.h"

namespace si {

inline constexpr std::size_t kMapFormats = 6;

/// How far the two parameters of glPolygonOffset(factor, units) move a plane's depth, as measured in maps of one
/// format. OpenGL 4.5, 14.6.5: offset = m factor + r units, where m lies between the larger of |dz/dx| and |dz/dy| and
/// their length, and r is "the smallest value that is guaranteed to produce a resolvable offset": steps of the format,
/// and in float formats of the largest depth of the triangle. Unmeasured it holds the least that OpenGL allows.
struct PolygonOffset {
    bool measured = false;
    /// r = unit_depth + unit_steps x the format's step at the depth; one of the two is 0.
    double unit_depth = 0, unit_steps = 1;
    bool slope_is_length = false;  ///< m is the length of the depth's slope, else its larger component
    double slope_gain = 1;         ///< m over that

    /// Depth of one unit at a depth where the format's step is `quantum`.
    double unit(double quantum) const { return unit_depth + unit_steps * quantum; }
    /// Depth of a factor of 1 where depth falls by `per_texel` along the axes of the map.
    double slope(const glm::dvec2& per_texel) const;
};

struct RasterTraits {
    int subpixel_bits = 0;                            ///< GL_SUBPIXEL_BITS
    std::array<PolygonOffset, kMapFormats> offset{};  ///< by MapFormat
};

/// Draws planes into a small map of the format with and without an offset and reads the differences back:
/// flat ones at several depths for r, tilted ones in several directions for m. Of what differs by depth or direction
/// the least counts, and of each reading one step less. Leaves the OpenGL state as it was. Needs a current context.
PolygonOffset measure_polygon_offset(MapFormat format);

}  // namespace si
