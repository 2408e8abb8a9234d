#include "renderer/measure/measured_error.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "renderer/measure/axes.h"
#include "renderer/reference/flip.h"
#include "renderer/reference/umbra.h"
#include "renderer/view/lights/kernel_reach.h"

namespace si {
namespace {

/// Marks the pixels that are lit in the umbra.
void find_leaks(MeasuredError& measured, const Workers& workers) {
    const Reference& reference = *measured.traced.reference;
    std::vector<std::size_t> bright;
    for (std::size_t i = 0; i < measured.classified.size(); ++i)
        if (reference.state[i] == PixelState::Counted && reference.visibility.data[i] == 0 &&
            measured.classified[i].visibility > shared::VISIBLE_ERROR)
            bright.push_back(i);
    const std::vector<std::uint8_t> in_umbra = umbra_of(measured.traced, measured.lights[std::size_t(measured.light)],
                                                        measured.map_size, measured.reach_texels, bright, workers);
    for (std::size_t k = 0; k < bright.size(); ++k) measured.classified[bright[k]].any_leak = in_umbra[k] != 0;
}

/// Computes the metrics of pixels that were compared, but whose causes were not looked for.
void sum_without_causes(MeasuredError& measured) {
    ErrorMetrics& m = measured.metrics;
    m = error_metrics(measured.classified, *measured.traced.reference, measured.traced.receivers.get());
    m.without_cause = std::size_t(std::ranges::count_if(measured.classified, &ClassifiedPixel::is_wrong));
    for (const Metric& metric : metrics()) {
        const bool of_some_causes = metric.causes != 0 && metric.causes != kAllCauses;
        if (metric.member && of_some_causes) m.*metric.member = std::numeric_limits<double>::quiet_NaN();
    }
    m.any_acne = m.visible_acne = m.any_leak = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

MeasuredError read_classified_pixels(Renderer& renderer, const FrameResult& frame, const ReferencePicture& picture,
                                     const Settings& settings) {
    MeasuredError out;
    out.traced = picture.traced;
    out.classified = classified_pixels(subsample(renderer.read_float(frame.classified, 2), picture.step));
    out.lights = frame.lights;
    out.camera = frame.camera;
    out.light = settings.view.light;
    out.picture = {frame.classified.width, frame.classified.height};
    out.map_resolution = frame.map_resolution;
    out.map_size = frame.map_size;
    out.reach_texels = edge_reach_texels(settings, frame.lights[std::size_t(out.light)], frame.map_size);
    return out;
}

void sum_error_metrics(MeasuredError& measured, const Workers& workers) {
    find_leaks(measured, workers);
    measured.metrics = error_metrics(measured.classified, *measured.traced.reference, measured.traced.receivers.get());
    if (!measured.pictures) return;
    const PicturePair pair = *std::exchange(measured.pictures, std::nullopt);
    measured.metrics.flip = flip_difference(pair.drawn, pair.by_reference, kFlipPixelsPerDegree, workers).mean;
}

PicturePair draw_picture_pair(Renderer& renderer, const Scene& scene, const Settings& settings,
                              const FrameRequest& request) {
    FrameRequest pair = request;
    pair.outputs = {.colour = true, .true_colour = true};
    pair.timing = pair.force = pair.with_look = false;
    pair.smoothed = 0;
    const FrameResult frame = renderer.render(scene, measured_settings(settings), pair);
    return {renderer.read_colour(frame.colour), renderer.read_colour(frame.true_colour)};
}

MeasuredError measure_error(Renderer& renderer, const Scene& scene, const Settings& settings,
                            const FrameRequest& request, int light, const ReferenceOptions& options,
                            ReferenceCache& cache, const Workers& workers, bool of_pictures,
                            const NeedsCauses& needs_causes) {
    Settings shown = settings;
    shown.view.light = light;
    ReferenceOptions wanted = options;
    wanted.nearest = true;  // distinguishes lost casters from peter-panning
    FrameRequest classified = request;
    classified.timing = classified.force = false;
    if (needs_causes) {
        classified.outputs = {.colour = false, .compared = true};
        const FrameResult frame = render_with_reference(renderer, scene, shown, classified, cache, workers, wanted);
        MeasuredError out = read_classified_pixels(renderer, frame, *classified.reference, shown);
        sum_without_causes(out);
        if (!needs_causes(out)) return out;
    }
    classified.outputs = {.colour = false, .classified = true};
    const FrameResult frame = render_with_reference(renderer, scene, shown, classified, cache, workers, wanted);
    MeasuredError out = read_classified_pixels(renderer, frame, *classified.reference, shown);
    if (of_pictures) out.pictures = draw_picture_pair(renderer, scene, shown, classified);
    sum_error_metrics(out, workers);
    return out;
}

}  // namespace si
