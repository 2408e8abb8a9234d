#include "renderer/reference/truth_picture.h"

#include <atomic>
#include <cmath>

#include "renderer/reference/error_task.h"
#include "renderer/reference/live_error.h"

namespace si {
namespace {

std::uint64_t next_version() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

std::shared_ptr<const TruthPicture> truth_picture(const TruthTask& task, const TracedTruth& traced) {
    auto picture = std::make_shared<TruthPicture>();
    picture->key = task.key;
    picture->version = next_version();
    picture->step = task.raster.step;
    picture->traced = traced;
    return picture;
}

EdgeTask edge_task(Renderer& renderer, const FrameResult& frame, const Settings& settings, const FrameRequest& request) {
    EdgeTask task;
    task.picture = request.truth;
    task.edges_key = frame.truth.edges_key;
    const int step = request.truth->step;
    task.measured = every_nth(renderer.read_float(frame.visibility, 1), step);
    if (frame.map_coordinates.texture)
        task.map_coordinates = every_nth(renderer.read_float(frame.map_coordinates, 4), step);
    task.bias = settings.bias;
    task.light = frame.lights[std::size_t(settings.view.light)];
    task.map_resolution = frame.map_resolution;
    task.reach_texels = kernel_reach_texels(settings);
    return task;
}

std::shared_ptr<const TruthPicture> with_edges(const EdgeTask& task, TruthCache& cache, const Workers& workers) {
    auto picture = std::make_shared<TruthPicture>(*task.picture);
    const TracedTruth& traced = picture->traced;
    const bool same = picture->edges && picture->edges_key == task.edges_key;
    EdgeImage facts = same ? *picture->edges : EdgeImage(traced.truth->state.size(), kUnknownEdge);
    const std::vector<Footprint> footprints =
        differing_footprints(task.measured, task.map_coordinates, traced, task.light, task.bias, task.map_resolution,
                             nullptr, workers.part(0, 0.1));
    cache.edge_finder(traced.scene, task.light, task.map_resolution)
        .find(*traced.receivers, *traced.truth, task.reach_texels, footprints, facts, workers.part(0.1, 1));
    // Where the pixel's place in the map rounds differently here, there is nothing to be found.
    const float searched = float(task.reach_texels + 1);
    for (std::size_t i = 0; i < facts.size(); ++i) {
        const float difference = task.measured.data[i] - traced.truth->visibility.data[i];
        if (footprints[i].view < 0 && !(std::abs(difference) <= kRightVisibility) && facts[i].searched < searched)
            facts[i] = {std::numeric_limits<float>::infinity(), searched};
    }
    picture->edges = std::make_shared<const EdgeImage>(std::move(facts));
    picture->edges_key = task.edges_key;
    picture->version = next_version();
    return picture;
}

FrameResult render_with_truth(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                              TruthCache& cache, const Workers& workers) {
    FrameResult frame = renderer.render(scene, settings, request);
    if (frame.truth.key == 0) return frame;
    if (!frame.truth.met) {
        const TruthTask task = truth_task(renderer, scene, settings, request, settings.view.light, truth_options(settings),
                                          cache.geometry());
        request.truth = truth_picture(task, cache.trace(task, workers.part(0, 0.8)));
    }
    FrameRequest judged = request;
    judged.outputs = {.colour = false, .visibility = true, .map_coordinates = true, .error = true};
    judged.timing = judged.force = false;
    const FrameResult found = renderer.render(scene, settings, judged);
    if (found.error && found.error->undecided > 0)
        request.truth = with_edges(edge_task(renderer, found, settings, judged), cache, workers.part(0.8, 1));
    return renderer.render(scene, settings, request);
}

}  // namespace si
