#include "renderer/reference/error_task.h"

#include "renderer/settings/map_storage.h"
#include "renderer/view/kernel_reach.h"

namespace si {

CauseContext cause_context(const Settings& settings, const FittedLight& light, int map_resolution, bool mask_levels) {
    return {.has_map = light.casts,
            .edge_reach_texels = reach_under(settings, light, map_resolution).edge,
            .raster_bias = offsets_polygons(settings),
            .mask_levels = mask_levels,
            .depth_blur = settings.map.blur_texels > 0};
}

MeasuredError read_classified_pixels(Renderer& renderer, const FrameResult& frame, const TruthPicture& picture,
                                     int light) {
    MeasuredError out;
    out.traced = picture.traced;
    out.judged = classified_pixels(every_nth(renderer.read_float(frame.judged, 2), picture.step));
    out.lights = frame.lights;
    out.camera = frame.camera;
    out.light = light;
    out.picture = {frame.judged.width, frame.judged.height};
    out.map_resolution = frame.map_resolution;
    return out;
}

void sum_error_metrics(MeasuredError& measured) {
    measured.metrics =
        error_metrics(measured.judged, *measured.traced.truth, same_surface_bits(*measured.traced.receivers));
}

MeasuredError measure_error(Renderer& renderer, const Scene& scene, const Settings& settings,
                            const FrameRequest& request, int light, const TruthOptions& options, TruthCache& cache,
                            const Workers& workers) {
    Settings shown = settings;
    shown.view.light = light;
    TruthOptions wanted = options;
    wanted.nearest = true;  // distinguishes lost casters from peter-panning
    FrameRequest judged = request;
    judged.outputs = {.colour = false, .judged = true};
    judged.timing = judged.force = false;
    const FrameResult frame = render_with_truth(renderer, scene, shown, judged, cache, workers, wanted);
    MeasuredError out = read_classified_pixels(renderer, frame, *judged.truth, light);
    sum_error_metrics(out);
    return out;
}

}  // namespace si
