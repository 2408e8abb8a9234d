#include "renderer/reference/error_task.h"

#include <chrono>
#include <cmath>
#include <utility>

#include "renderer/light_receiver.h"
#include "renderer/reference/light_space.h"
#include "renderer/techniques.h"

namespace si {

std::vector<Footprint> differing_footprints(const FloatImage& measured, const FloatImage& map_coordinates,
                                            const TracedTruth& traced, const FittedLight& light, const BiasSettings& bias,
                                            int map_resolution, PixelFacts* facts, const Workers& workers) {
    const Truth& truth = *traced.truth;
    const std::size_t n = truth.state.size(), width = std::size_t(truth.width);
    std::vector<Footprint> footprints(n);
    if (facts) {
        facts->outside_map.assign(n, 0);
        facts->bias_m.assign(n, 0);
        facts->joins.assign(n, 0);
    }
    for_blocks(std::size_t(truth.height), workers, [&](std::size_t y) {
        for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
            const Receiver& r = traced.receivers->pixels[i];
            if (facts) facts->joins[i] = std::uint8_t(r.joins_right | r.joins_below << 1);
            if (truth.state[i] != PixelState::Counted || !light.casts) continue;
            const double difference = measured.data[i] - truth.visibility.data[i];
            const bool differs = !(std::abs(difference) <= kRightVisibility);
            if (!facts && !differs) continue;
            // The geometric normal; by how much another one moves the kernel is in the map coordinates.
            const LightReceiver at =
                light_receiver(light, bias, map_resolution, r.position_ws, r.normal_ws, r.normal_ws);
            if (facts) {
                facts->outside_map[i] = !at.in_map();
                facts->bias_m[i] = float(at.bias_m / at.axis_per_ray + at.normal_offset_m * at.n_dot_l);
            }
            if (!at.in_map() || !differs) continue;
            const float* kernel = &map_coordinates.data[4 * i];
            footprints[i].own = glm::dvec2(at.uvd) * double(map_resolution);
            footprints[i].centre = kernel[3] > 0 ? glm::dvec2(kernel[0], kernel[1]) * double(map_resolution)
                                                 : footprints[i].own;
            footprints[i].view = int(at.view);
        }
    });
    return footprints;
}

double kernel_reach_texels(const Settings& settings) {
    return filters()[std::size_t(settings.filter.kernel)].reach_texels + settings.map.blur_texels;
}

ErrorTask error_task(Renderer& renderer, const Scene& scene, const Settings& settings, const FrameRequest& request,
                     int light, const TruthOptions& options, const std::shared_ptr<const TruthGeometry>& known) {
    ErrorTask task;
    TruthOptions all = options;
    all.nearest = true;  // by which lost casters and peter-panning are told apart
    task.truth = truth_task(renderer, scene, settings, request, light, all, known);
    FrameRequest wanted = request;
    wanted.outputs = {.colour = false, .visibility = true, .map_coordinates = true};
    wanted.timing = false;
    Settings shown = settings;
    shown.view.light = light;
    const FrameResult frame = renderer.render(scene, shown, wanted);
    task.measured = every_nth(renderer.read_float(frame.visibility, 1), options.step);
    if (frame.map_coordinates.texture)
        task.map_coordinates = every_nth(renderer.read_float(frame.map_coordinates, 4), options.step);
    task.bias = settings.bias;
    task.light = light;
    task.reach_texels = kernel_reach_texels(settings);
    return task;
}

namespace {

MeasuredError compared(const ErrorTask& task, TracedTruth traced, EdgeFinder& edges_of, const Workers& workers) {
    MeasuredError out;
    out.traced = std::move(traced);
    const auto start = std::chrono::steady_clock::now();
    const FittedLight& light = task.truth.lights[std::size_t(task.light)];
    const int resolution = task.truth.map_resolution;
    const std::vector<Footprint> footprints =
        differing_footprints(task.measured, task.map_coordinates, out.traced, light, task.bias, resolution, &out.facts,
                             workers.part(0, 0.25));
    EdgeImage edges(footprints.size(), kUnknownEdge);
    edges_of.find(*out.traced.receivers, *out.traced.truth, task.reach_texels, footprints, edges, workers.part(0.25, 1));
    out.facts.edge_texels.resize(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) out.facts.edge_texels[i] = edges[i].texels;
    out.metrics = error_metrics(task.measured, *out.traced.truth, out.facts, &out.artefacts);
    out.classify_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return out;
}

}  // namespace

MeasuredError measure_error(const ErrorTask& task, TruthCache& cache, const Workers& workers) {
    TracedTruth traced = cache.trace(task.truth, workers.part(0, 0.8));
    const FittedLight& light = task.truth.lights[std::size_t(task.light)];
    EdgeFinder& edges = cache.edge_finder(traced.scene, light, task.truth.map_resolution);
    return compared(task, std::move(traced), edges, workers.part(0.8, 1));
}

MeasuredError compare_with_truth(const ErrorTask& task, TracedTruth traced, const Workers& workers) {
    EdgeFinder edges(*traced.scene, task.truth.lights[std::size_t(task.light)], task.truth.map_resolution);
    return compared(task, std::move(traced), edges, workers);
}

}  // namespace si
