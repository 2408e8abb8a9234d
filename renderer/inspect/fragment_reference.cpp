#include "renderer/inspect/fragment_reference.h"

#include <cmath>

#include "renderer/reference/umbra.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

/// Returns the difference in depth between the probed point and a surface `metres` nearer along the light's ray; 0:
/// none.
float depth_of_gap(const Probe::PerLight& p, double metres) {
    if (!p.casts || std::isnan(metres)) return 0;
    const LightView& view = p.fitted.views[std::size_t(p.face)];
    const double along = metres * glm::dot(p.account.receiver.to_light, view.axes[2]);
    const DepthCurve& curve = p.account.curve;
    return float(std::abs(curve.depth(p.account.receiver.own_m) - curve.depth(p.account.receiver.own_m - along)));
}

}  // namespace

FragmentReference trace_fragment_reference(const ReferenceScene& scene, const Probe& probe,
                                           const Probe::PerLight& light, const Settings& settings,
                                           std::span<const ObjectTraits> traits) {
    if (!probe.hit) throw Error("the probed pixel shows no surface");
    const Workers here{.threads = 1};
    const PixelRaster raster{probe.width, probe.height, 1, probe.around_at};
    const Receivers around = reconstruct_receivers(scene.geometry(), probe.camera, probe.around, raster, here);
    ReferenceQuery query{emitter_of(light.fitted, settings.lights[std::size_t(light.light)]),
                         {traits.begin(), traits.end()},
                         light.fitted.views,
                         light.fitted.chooser,
                         {.nearest = false}};
    const Reference neighbours = trace_visibility(scene, around, query, here);
    const ShadowRuns runs = shadow_runs(neighbours, around, probe.camera, raster, query, here);
    const glm::ivec2 at = glm::ivec2(probe.x, probe.y) - probe.around_at;
    query.options = {.area = true};
    const Reference own = trace_visibility(scene, {1, 1, {around.at(at.x, at.y)}}, query, here);

    FragmentReference out;
    out.state = own.state[0];
    out.lit = own.hard().data[0] >= 0.5f;
    out.share = own.visibility.data[0];
    out.noise = own.noise;
    out.gap_m = own.nearest_m.data[0];
    out.blocker_m = own.blocker_m.data[0];
    out.evidence = light.evidence;
    out.evidence.gap_drawn = depth_of_gap(light, out.gap_m);
    out.evidence.gap_all = depth_of_gap(light, out.blocker_m);
    out.evidence.run_m = runs.run_m.at(at.x, at.y);
    out.evidence.edge_m = runs.edge_m.at(at.x, at.y);
    if (out.state == PixelState::Counted && !out.lit) {
        out.missing = missing_caster(scene, around.at(at.x, at.y), query);
        if (out.missing) out.missing_path = scene.geometry().objects[out.missing->object].path;
    }
    if (out.state == PixelState::Counted)
        out.cause = cause_of(out.evidence, {.visibility = out.lit ? 1.0 : 0.0, .hard_lit = out.lit}, light.causes);
    out.any_leak = light.visibility > shared::VISIBLE_ERROR && !out.lit &&
                   in_umbra(scene, around.at(at.x, at.y), query, light.fitted, probe.map_size,
                            edge_reach_texels(settings, light.fitted, probe.map_size));
    return out;
}

}  // namespace si
