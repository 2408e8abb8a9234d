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

MeasuredError read_classified(Renderer& renderer, const FrameResult& frame, const ReferencePicture& picture,
                              int light) {
    MeasuredError out;
    out.traced = picture.traced;
    out.classified = classified_pixels(every_nth(renderer.read_float(frame.classified, 2), picture.step));
    out.lights = frame.lights;
    out.camera = frame.camera;
    out.light = light;
    out.picture = {frame.classified.width, frame.classified.height};
    out.map_resolution = frame.map_resolution;
    return out;
}

void sum_up(MeasuredError& measured) {
    measured.metrics =
        error_metrics(measured.classified, *measured.traced.reference, joins_of(*measured.traced.receivers));
}

MeasuredError measure_error(Renderer& renderer, const Scene& scene, const Settings& settings,
                            const FrameRequest& request, int light, const ReferenceOptions& options,
                            ReferenceCache& cache, const Workers& workers) {
    Settings shown = settings;
    shown.view.light = light;
    ReferenceOptions wanted = options;
    wanted.nearest = true;  // by which lost casters and peter-panning are told apart
    FrameRequest classified = request;
    classified.outputs = {.colour = false, .classified = true};
    classified.timing = classified.force = false;
    const FrameResult frame = render_with_reference(renderer, scene, shown, classified, cache, workers, wanted);
    MeasuredError out = read_classified(renderer, frame, *classified.reference, light);
    sum_up(out);
    return out;
}

}  // namespace si
