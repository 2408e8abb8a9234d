// Fits of six cube faces, for a point light or a cone too wide for one map.
#include <array>
#include <cmath>
#include <utility>

#include "renderer/view/fits/fit_context.h"
#include "renderer/view/fits/near_far.h"

namespace si {
namespace {

/// Right, up and back of the six faces, oriented like the faces of a GL cube map.
const std::array<glm::dmat3, 6>& cube_axes() {
    static const std::array<glm::dmat3, 6> axes = [] {
        const std::array<std::pair<glm::dvec3, glm::dvec3>, 6> forward_up = {{{{1, 0, 0}, {0, -1, 0}},
                                                                              {{-1, 0, 0}, {0, -1, 0}},
                                                                              {{0, 1, 0}, {0, 0, 1}},
                                                                              {{0, -1, 0}, {0, 0, -1}},
                                                                              {{0, 0, 1}, {0, -1, 0}},
                                                                              {{0, 0, -1}, {0, -1, 0}}}};
        std::array<glm::dmat3, 6> result;
        for (int i = 0; i < 6; ++i) {
            const auto& [forward, up] = forward_up[i];
            result[i] = glm::dmat3(glm::cross(forward, up), up, -forward);
        }
        return result;
    }();
    return axes;
}

}  // namespace

double face_margin_texels(const Settings& settings) {
    return settings.map.face_guard ? whole_reach_texels(settings) : 0;
}

void fit_faces(FittedLight& light, const FitContext& c) {
    std::array<LightView, 6> faces;
    DepthCurve range;
    for (int i = 0; i < 6; ++i) {
        faces[i].eye = light.position;
        faces[i].axes = cube_axes()[i];
        faces[i].set_half_extents(glm::dvec2(half_extent_with_margin(1.0, 0, c.resolution, c.face_margin_texels)));
        set_perspective_range(faces[i], c);
        const DepthCurve& curve = faces[i].curve;
        if (i == 0) range = curve;
        range.near = std::min(range.near, curve.near);
        range.far = std::max(range.far, curve.far);
    }
    range.near = std::max(range.near, kMinNearShare * range.far);
    for (LightView& face : faces) {
        face.curve = range;
        add_finished_view(light, face, c, range.far);
    }
    light.chooser = {ViewChoice::Face, light.position, {}, {}};
    if (c.settings.projection == LightProjection::Orthographic)
        add_note(light, "six faces are always perspective: light.projection has no effect");
}

}  // namespace si
