#include "ui/scene_view/probe_anchor.h"

#include <algorithm>
#include <cmath>

#include "ui/scene_view/picture_view.h"

namespace si {
namespace {

constexpr double kNearerShare = 1e-3;  ///< share of the distance by which another surface is nearer
constexpr double kNearerPixels = 2;    ///< or number of pixels, at that distance

}  // namespace

std::optional<glm::ivec2> anchored_pixel(const ProbeAnchor& anchor, const Camera& camera, int width, int height) {
    const glm::dvec4 at = camera.project(anchor.position_ws, width, height);
    if (!(at.w > 0) || !(at.x >= -0.5 && at.y >= -0.5 && at.x < width - 0.5 && at.y < height - 0.5)) return {};
    return glm::ivec2(int(std::floor(at.x + 0.5)), int(std::floor(at.y + 0.5)));
}

bool hides(const Probe& probe, const ProbeAnchor& anchor) {
    if (!probe.hit) return false;
    const Camera& camera = probe.camera;
    const PictureView view{camera, {0, 0}, {double(probe.width), double(probe.height)}, 1};
    // The pixel's ray meets the anchor's plane up to half a pixel away from the anchor.
    const Ray ray = view.ray({probe.x + 0.5, probe.y + 0.5});
    const glm::dvec3 away = anchor.position_ws - camera.eye;
    const double across = 1.5 * view.metres_per_pixel(anchor.position_ws);
    glm::dvec3 expected = anchor.position_ws;
    if (const auto met = intersect_plane(ray, anchor.position_ws, anchor.normal_ws);
        met && glm::distance(*met, anchor.position_ws) < 0.1 * glm::length(away))
        expected = *met;
    const double nearer = glm::dot(probe.position_ws - expected, camera.axes[2]);
    return nearer > std::max(kNearerShare * std::abs(glm::dot(away, camera.axes[2])), kNearerPixels * across);
}

std::optional<ProbeRay> probe_ray(const Probe& probe, const Probe::PerLight& p, const FittedLight& fitted) {
    if (!probe.hit || !p.casts || std::size_t(p.face) >= fitted.views.size() || p.place == MapPlace::Behind) return {};
    const LightView& view = fitted.views[std::size_t(p.face)];
    ProbeRay ray;
    ray.to = probe.position_ws;
    const glm::dvec3 to_light = view.axes[2];
    ray.from =
        view.curve.perspective ? view.eye : ray.to + to_light * (p.account.receiver.own_m - p.account.curve.near);
    // Beyond the far plane no depth is compared; outside the map the border's depth is no surface.
    ray.blocked = p.place == MapPlace::Inside && p.visibility < 1 && p.stored_m < p.account.receiver.own_m;
    ray.occluder = ray.to;
    if (!ray.blocked) return ray;
    ray.occluder = view.curve.perspective ? view.eye + (ray.to - view.eye) * (p.stored_m / p.account.receiver.own_m)
                                          : ray.to + to_light * (p.account.receiver.own_m - p.stored_m);
    return ray;
}

}  // namespace si
