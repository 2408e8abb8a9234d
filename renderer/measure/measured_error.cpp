#include "renderer/measure/measured_error.h"

namespace si {

MeasuredError read_classified_pixels(Renderer& renderer, const FrameResult& frame, const ReferencePicture& picture,
                                     int light) {
    MeasuredError out;
    out.traced = picture.traced;
    out.classified = classified_pixels(subsample(renderer.read_float(frame.classified, 2), picture.step));
    out.lights = frame.lights;
    out.camera = frame.camera;
    out.light = light;
    out.picture = {frame.classified.width, frame.classified.height};
    out.map_resolution = frame.map_resolution;
    return out;
}

void sum_error_metrics(MeasuredError& measured) {
    measured.metrics =
        error_metrics(measured.classified, *measured.traced.reference, same_surface_bits(*measured.traced.receivers));
}

MeasuredError measure_error(Renderer& renderer, const Scene& scene, const Settings& settings,
                            const FrameRequest& request, int light, const ReferenceOptions& options,
                            ReferenceCache& cache, const Workers& workers) {
    Settings shown = settings;
    shown.view.light = light;
    ReferenceOptions wanted = options;
    wanted.nearest = true;  // distinguishes lost casters from peter-panning
    FrameRequest classified = request;
    classified.outputs = {.colour = false, .classified = true};
    classified.timing = classified.force = false;
    const FrameResult frame = render_with_reference(renderer, scene, shown, classified, cache, workers, wanted);
    MeasuredError out = read_classified_pixels(renderer, frame, *classified.reference, light);
    sum_error_metrics(out);
    return out;
}

}  // namespace si
