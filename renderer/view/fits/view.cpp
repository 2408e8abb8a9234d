// The receivers that the camera sees, and the casters between them and the light: what Brabec, Annen, Seidel, Practical
// Shadow Mapping, Journal of Graphics Tools 7(4), 2002, call the focus of a shadow map, narrowed to where shadows can
// be.
#include <algorithm>
#include <cmath>

#include "renderer/view/fits/shadowed.h"

namespace si {
namespace {

/// What the camera sees between its near and far planes.
Box frustum_of(const Camera& camera) {
    Box box;
    for (int i = 0; i < 8; ++i) {
        const double z = i & 4 ? camera.curve.far : camera.curve.near;
        const double half = camera.orthographic ? 0.5 * camera.height : z * std::tan(0.5 * camera.fov_y_rad);
        box[std::size_t(i)] =
            camera.eye + camera.axes * glm::dvec3((i & 1 ? 1 : -1) * half * camera.aspect, (i & 2 ? 1 : -1) * half, -z);
    }
    return box;
}

}  // namespace

std::optional<MapRegion> fit_view(const FitInput& in) {
    if (!in.camera) return fit_casters(in);
    const Box frustum = frustum_of(*in.camera);
    const std::vector<HalfSpace> sides = half_spaces_of(frustum);
    std::vector<ViewExtent> receivers(in.shape.boxes.size());
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        if (!in.shape.box_receives[i]) continue;
        const Box& box = in.shape.boxes[i];
        const bool whole = std::ranges::all_of(sides, [&](const HalfSpace& side) {
            return std::ranges::all_of(box, [&](const glm::dvec3& p) { return side.distance(p) >= 0; });
        });
        receivers[i] =
            whole ? lit_extent(in, i) : lit_extent(in, common_points(box, half_spaces_of(box), frustum, sides));
    }
    return shadowed_region(in, receivers);
}

}  // namespace si
