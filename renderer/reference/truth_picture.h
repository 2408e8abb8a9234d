// A traced truth as frames take it: per pixel, with what is known by now of the true edges near each kernel.
//
//     TruthTask task = truth_task(renderer, scene, settings, request, light, truth_options(settings), cache.geometry());
//     request.truth = truth_picture(task, cache.trace(task));             // any thread
//     FrameResult frame = renderer.render(scene, settings, request);      // frame.truth.met, frame.error
//     EdgeTask edges = edge_task(renderer, frame, settings, request);     // while frame.error->undecided > 0
//     request.truth = with_edges(edges, cache);                           // any thread
#pragma once

#include <memory>

#include "renderer/reference/light_space.h"
#include "renderer/reference/truth_task.h"

namespace si {

struct TruthPicture {
    std::uint64_t key = 0;        ///< truth_key() of the frames that it is for
    std::uint64_t edges_key = 0;  ///< TruthNeed::edges_key of the frames that `edges` are for
    std::uint64_t version = 0;    ///< another one for each content
    int step = 1;                 ///< pixels of the frame per pixel of the truth
    TracedTruth traced;
    std::shared_ptr<const EdgeImage> edges;  ///< by pixel of the truth; null: nothing known
};

std::shared_ptr<const TruthPicture> truth_picture(const TruthTask& task, const TracedTruth& traced);

/// What finding edges takes; it touches neither scene nor GPU any more.
struct EdgeTask {
    std::shared_ptr<const TruthPicture> picture;
    std::uint64_t edges_key = 0;
    FloatImage measured;         ///< visibility as the settings draw it, by pixel of the truth
    FloatImage map_coordinates;  ///< likewise; empty when the light has no map
    BiasSettings bias;
    FittedLight light;
    int map_resolution = 0;
    double reach_texels = 0.5;
};

/// Reads back what `frame` drew. It must have been asked for visibility and map coordinates with `request.truth`, and
/// truth.met.
EdgeTask edge_task(Renderer& renderer, const FrameResult& frame, const Settings& settings, const FrameRequest& request);

/// The picture with the edges that this frame needs. @throws Cancelled
std::shared_ptr<const TruthPicture> with_edges(const EdgeTask& task, TruthCache& cache, const Workers& workers = {});

/// Draws a frame that has the truth it asks for: traced unless `request` or `cache` has it, with all edges it takes.
/// @param request keeps the truth for the next frame. @throws Cancelled, Error
FrameResult render_with_truth(Renderer& renderer, const Scene& scene, const Settings& settings, FrameRequest& request,
                              TruthCache& cache, const Workers& workers = {});

}  // namespace si
