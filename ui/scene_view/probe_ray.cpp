#include "ui/scene_view/probe_ray.h"

namespace si {

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
