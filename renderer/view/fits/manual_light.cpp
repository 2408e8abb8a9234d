#include "renderer/view/fits/manual_light.h"

#include "renderer/scene/scene.h"
#include "renderer/settings/fits.h"

namespace si {
namespace {

// Distance of the light from an orthographic near plane, as a share of the range; light.near must be positive.
constexpr double kStandBack = 0.01;
constexpr double kSamePlace = 1e-12;  // share of the light's distance

bool leaves_nothing(const LightSettings& s, bool orthographic) {
    return s.fit == LightFit::Manual && uses_manual_near_far(s) && s.distance > 0 && s.near > 0 && s.far > 0 &&
           (s.extent > 0 || !orthographic);
}

}  // namespace

glm::dvec3 target_origin(const LightSettings& s, const FittedLight& fitted) {
    return fitted.target - glm::dvec3(s.target_x, s.target_y, s.target_z);
}

LightSettings manual_light(const LightSettings& settings, const FittedLight& fitted) {
    LightSettings s = settings;
    const bool orthographic = !fitted.views.empty() && !fitted.views[0].curve.perspective;
    if (leaves_nothing(s, orthographic)) return s;
    s.fit = LightFit::Manual;
    s.near_far = NearFar::Fitted;
    if (!(s.distance > 0)) s.distance = glm::distance(fitted.position, fitted.target);
    if (fitted.views.empty()) return s;
    const LightView& view = fitted.views[0];
    s.near = view.curve.near;
    s.far = view.curve.far;
    // A map bounded by the cone keeps following the cone.
    if (!orthographic && fitted.closed) s.extent = view.half_extent() * s.distance;
    if (!orthographic) return s;
    s.extent = view.half_extent();
    glm::dvec2 middle(0);
    if (view.warped()) {  // the square around the corners of the warped map
        Bounds2 around;
        for (int i = 0; i < 4; ++i)
            around.add(glm::dvec2(glm::transpose(view.axes) * (view.position_ws({i & 1, i >> 1}, 0) - view.eye)));
        const auto& [lo, hi] = around;
        s.extent = 0.5 * std::max(hi.x - lo.x, hi.y - lo.y);
        middle = 0.5 * (lo + hi);
    }
    if (fitted.type != LightType::Directional) {
        // A range that begins at the light is what 0 means.
        if (s.near <= 0) s.near = 0;
        return s;
    }
    // A fit moves the map sideways to the middle of the scene; a manual map lies about the target.
    const glm::dvec3 aside = view.eye + view.axes * glm::dvec3(middle, 0) - fitted.position;
    if (glm::length(aside) > kSamePlace * s.distance) {
        s.target_x += aside.x;
        s.target_y += aside.y;
        s.target_z += aside.z;
    }
    // Parallel rays look the same from farther back.
    if (s.near <= 0) {
        const double back = kStandBack * (s.far - s.near) - s.near;
        s.distance += back;
        s.near += back;
        s.far += back;
    }
    return s;
}

}  // namespace si
