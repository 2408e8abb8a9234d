#include "app/editor/artefact_spots.h"

#include "renderer/measure/measured_error.h"

namespace si {
namespace {

constexpr std::size_t kMaxSpots = 100;  ///< number of clusters in a tour

}  // namespace

ArtefactSpots find_artefact_spots(Renderer& renderer, const Scene& scene, const Settings& settings,
                                  const FrameRequest& request, const ArtefactRequest& wanted) {
    FrameRequest classified = request;
    classified.outputs = {.colour = false, .classified = true};
    classified.timing = classified.force = false;
    const FrameResult frame = renderer.render(scene, settings, classified);
    const MeasuredError measured = read_classified_pixels(renderer, frame, *request.reference, settings.view.light);
    const Receivers& receivers = *measured.traced.receivers;
    const int step = request.reference->step;
    ArtefactSpots out{.number = wanted.number, .spots = {}, .camera = frame.camera, .height = request.height};
    for (const ArtefactCluster& found :
         artefact_clusters(measured.classified, receivers.width, wanted.cause, kMaxSpots)) {
        ArtefactSpot spot{found};
        const Receiver& middle = receivers.at(found.pixel.x, found.pixel.y);
        spot.position_ws = middle.position_ws;
        spot.normal_ws = middle.normal_ws;
        spot.pixel *= step;
        spot.first *= step;
        spot.last = (spot.last + 1) * step - 1;
        out.spots.push_back(spot);
    }
    return out;
}

}  // namespace si
