#include "renderer/reference/fragment_truth.h"

#include "renderer/reference/error_task.h"

namespace si {
namespace {

/// The scene and receivers are on somebody else's account.
template <typename T>
std::shared_ptr<const T> borrowed(const T& value) {
    return {std::shared_ptr<const T>(), &value};
}

FloatImage pixel_of(std::vector<float> channels) {
    return {1, 1, int(channels.size()), std::move(channels)};
}

/// The probe's pixel as a picture of one pixel.
ErrorTask task_of(const Probe& probe, const Probe::PerLight& light, const Settings& settings) {
    ErrorTask task;
    task.truth.lights = {light.fitted};
    task.truth.map_resolution = probe.map_resolution;
    task.measured = pixel_of({float(light.visibility)});
    const bool reads = light.casts && light.where != "behind";
    task.map_coordinates = pixel_of({float(light.tap.x), float(light.tap.y), float(light.face), reads ? 1.f : 0.f});
    task.bias = settings.bias;
    task.reach_texels = kernel_reach_texels(settings);
    return task;
}

}  // namespace

FragmentTruth fragment_truth(const TruthScene& scene, const Probe& probe, const Probe::PerLight& light,
                             const Settings& settings, std::span<const ObjectTraits> traits) {
    if (!probe.hit) throw Error("the probed pixel shows no surface");
    const Workers here{.threads = 1};
    const Receivers one{1, 1, {place_receiver(scene.geometry(), probe.camera, probe.id, {probe.x, probe.y}, probe.width,
                                              probe.height)}};
    TruthQuery query{emitter_of(light.fitted, settings.lights[std::size_t(light.light)]),
                     {traits.begin(), traits.end()},
                     light.fitted.views,
                     {.area = true}};
    const Truth sized = trace_visibility(scene, one, query, here);
    Truth point = sized;  // artefacts are told apart against a light without size, as its map draws it
    point.visibility = sized.hard();
    point.point_visibility = {};
    FragmentTruth out;
    out.state = sized.state[0];
    out.lit = sized.hard().data[0] >= 0.5f;
    out.share = sized.visibility.data[0];
    out.noise = sized.noise;
    out.gap_m = sized.nearest_m.data[0];
    const MeasuredError judged =
        compare_with_truth(task_of(probe, light, settings),
                           {borrowed(scene), borrowed(one), borrowed(point)}, here);
    out.artefact = judged.artefacts[0];
    return out;
}

}  // namespace si
