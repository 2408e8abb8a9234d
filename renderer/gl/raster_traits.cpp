#include "renderer/gl/raster_traits.h"

#include <algorithm>

namespace si {

double PolygonOffset::slope(const glm::dvec2& per_texel) const {
    const glm::dvec2 s = glm::abs(per_texel);
    return slope_gain * (slope_is_length ? glm::length(s) : std::max(s.x, s.y));
}

}  // namespace si
