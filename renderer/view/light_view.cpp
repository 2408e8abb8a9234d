#include "renderer/view/light_view.h"

#include "renderer/view/projection.h"

namespace si {

glm::dmat4 LightView::clip_from_relative(const glm::dvec3& origin) const {
    return si::clip_from_relative(projection, axes, eye, origin);
}

glm::dvec3 LightView::position_ws(const glm::dvec2& uv, double z) const {
    const double half = half_width * (curve.perspective ? z : 1.0);
    return eye + axes * glm::dvec3((2.0 * uv - 1.0) * half, -z);
}

}  // namespace si
