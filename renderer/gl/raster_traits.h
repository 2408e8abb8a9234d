// Driver properties that bias depends on: sub-pixel bits, and the equivalent depth bias of glPolygonOffset, which
// OpenGL leaves to the driver.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace si {

inline constexpr std::size_t kMapFormats = 6;  ///< number of MapFormat values

/// Measured depth shift by which a driver implements glPolygonOffset(factor, units) in shadow maps of one format.
/// OpenGL 4.5, 14.6.5: offset = m factor + r units. m lies between the larger of |dz/dx| and |dz/dy| and the length of
/// (dz/dx, dz/dy). r is "the smallest value that is guaranteed to produce a resolvable offset": a step of the format,
/// for float formats at the largest depth of the triangle. Without a measurement the values are the least that OpenGL
/// allows.
struct PolygonOffset {
    bool measured = false;
    /// r = unit_depth + unit_steps x the format's step at the depth; one of the two is 0.
    double unit_depth = 0, unit_steps = 1;
    bool slope_is_length = false;  ///< true: m follows the length of the slope; false: its larger component
    double slope_gain = 1;         ///< m divided by the length or larger component of the slope

    /// Returns the depth shift of glPolygonOffset(0, 1) at a depth where the map format's step is `quantum`.
    double unit(double quantum) const { return unit_depth + unit_steps * quantum; }
    /// Returns the depth shift of glPolygonOffset(1, 0) on a plane. @param per_texel change of depth per texel along u
    /// and v
    double slope(const glm::dvec2& per_texel) const {
        const glm::dvec2 s = glm::abs(per_texel);
        return slope_gain * (slope_is_length ? glm::length(s) : std::max(s.x, s.y));
    }
};

/// Properties of the driver's rasteriser on which shadow bias depends: sub-pixel bits, and the effect of
/// glPolygonOffset for each map format.
struct RasterTraits {
    int subpixel_bits = 0;                            ///< GL_SUBPIXEL_BITS
    std::array<PolygonOffset, kMapFormats> offset{};  ///< by MapFormat
};

}  // namespace si
