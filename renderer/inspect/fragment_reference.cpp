#include "renderer/inspect/fragment_reference.h"

#include <cmath>

#include "renderer/reference/umbra.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

/// Distance up to which the reference of an area light looks at the neighbours of a pixel, in pixels.
constexpr int kNeighbourPixels = 2;

/// Returns the receivers around a pixel, clipped to those given.
/// @param[in,out] at the pixel; becomes its place among those returned
Receivers neighbourhood(const Receivers& all, glm::ivec2& at) {
    const glm::ivec2 first = glm::max(at - kNeighbourPixels, glm::ivec2(0));
    const glm::ivec2 end = glm::min(at + kNeighbourPixels + 1, glm::ivec2(all.width, all.height));
    Receivers out{.width = end.x - first.x, .height = end.y - first.y, .pixels = {}};
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) out.pixels.push_back(all.at(x, y));
    at -= first;
    return out;
}

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
    // An area light gets more rays where a neighbour lies in its penumbra.
    glm::ivec2 place = at;
    const Receivers near = neighbourhood(around, place);
    const Reference own = trace_visibility(scene, near, query, here);
    const auto i = std::size_t(place.y) * std::size_t(near.width) + std::size_t(place.x);

    FragmentReference out;
    out.state = own.state[i];
    out.lit = own.hard().data[i] >= 0.5f;
    out.share = own.visibility.data[i];
    out.noise = own.is_area() ? own.standard_error.data[i] : 0;
    out.gap_m = own.nearest_m.data[i];
    out.blocker_m = own.blocker_m.data[i];
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
