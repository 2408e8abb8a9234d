#include "renderer/measure/measure.h"

#include "renderer/measure/artefact_picture.h"
#include "renderer/measure/axes.h"

namespace si {

Judgement Measurer::judge(const Scene& scene, const Settings& settings) {
    const Settings measured = measured_settings(settings);
    FrameRequest request{.width = width_, .height = height_, .force = true};
    trace_sources(renderer_, scene, measured, request, truths_, workers_);
    Judgement judged;
    const FrameResult frame = renderer_.render(scene, measured, request);
    judged.cost = work_cost(measured, frame);
    judged.map_resolution = frame.map_resolution;
    judged.pages = frame.pages;
    judged.picture = renderer_.read_colour(frame.colour);
    judged.notes = frame.notes;
    request.force = false;
    const TruthOptions truth = truth_options(measured);
    const MeasuredError error =
        measure_error(renderer_, scene, measured, request, measured.view.light, truth, truths_, workers_);
    judged.error = error.metrics;
    judged.truth = error.traced.truth;
    judged.artefacts = artefact_picture(judged.picture, error.judged, truth.step);
    return judged;
}

FrameRequest Measurer::timed_request(const Scene& scene, const Settings& measured) {
    FrameRequest request{.width = width_, .height = height_};
    trace_sources(renderer_, scene, measured, request, truths_, workers_);
    request.timing = request.force = true;
    return request;
}

TimeSamples Measurer::time(const Scene& scene, const Settings& settings, int frames) {
    const Settings measured = measured_settings(settings);
    const FrameRequest request = timed_request(scene, measured);
    TimeSamples samples;
    renderer_.render(scene, measured, request);
    for (int i = 0; i < frames; ++i) samples.add(renderer_.render(scene, measured, request));
    return samples;
}

TimeMeasurement Measurer::time(const Scene& scene, const Settings& settings, const TimeSampler::Limits& limits) {
    const Settings measured = measured_settings(settings);
    const FrameRequest request = timed_request(scene, measured);
    return sample_times(limits, [&] {
        if (workers_.stop.stop_requested()) throw Cancelled();
        return renderer_.render(scene, measured, request);
    });
}

}  // namespace si
