#include "renderer/measure/measured_error.h"

namespace si {

MeasuredError read_judged(Renderer& renderer, const FrameResult& frame, const TruthPicture& picture, int light) {
    MeasuredError out;
    out.traced = picture.traced;
    out.judged = judged_pixels(every_nth(renderer.read_float(frame.judged, 2), picture.step));
    out.lights = frame.lights;
    out.camera = frame.camera;
    out.light = light;
    out.picture = {frame.judged.width, frame.judged.height};
    out.map_resolution = frame.map_resolution;
    return out;
}

void sum_up(MeasuredError& measured) {
    measured.metrics = error_metrics(measured.judged, *measured.traced.truth, joins_of(*measured.traced.receivers));
}

MeasuredError measure_error(Renderer& renderer, const Scene& scene, const Settings& settings,
                            const FrameRequest& request, int light, const TruthOptions& options, TruthCache& cache,
                            const Workers& workers) {
    Settings shown = settings;
    shown.view.light = light;
    TruthOptions wanted = options;
    wanted.nearest = true;  // by which lost casters and peter-panning are told apart
    FrameRequest judged = request;
    judged.outputs = {.colour = false, .judged = true};
    judged.timing = judged.force = false;
    const FrameResult frame = render_with_truth(renderer, scene, shown, judged, cache, workers, wanted);
    MeasuredError out = read_judged(renderer, frame, *judged.truth, light);
    sum_up(out);
    return out;
}

}  // namespace si
