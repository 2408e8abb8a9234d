#include "renderer/measure/measure.h"

#include <utility>

#include "renderer/measure/axes.h"
#include "renderer/reference/artefact_picture.h"

namespace si {

Classification Measurer::classify(const Scene& scene, const Settings& settings) {
    const Settings measured = measured_settings(settings);
    FrameRequest request{.width = width_, .height = height_, .force = true};
    trace_sources(renderer_, scene, measured, request, references_, workers_);
    Classification classified;
    const FrameResult frame = renderer_.render(scene, measured, request);
    classified.cost = work_cost(measured, frame);
    classified.map_resolution = frame.map_resolution;
    classified.pages = frame.pages;
    classified.lights = frame.lights;
    classified.picture = renderer_.read_colour(frame.colour);
    classified.notes = frame.notes;
    request.force = false;
    const ReferenceOptions reference = reference_options(measured);
    MeasuredError error =
        measure_error(renderer_, scene, measured, request, measured.view.light, reference, references_, workers_, true);
    classified.error = error.metrics;
    classified.reference = error.traced.reference;
    classified.artefacts = artefact_picture(classified.picture, error.classified, reference.step);
    classified.classified = std::move(error.classified);
    return classified;
}

TimedFrames::TimedFrames(Renderer& renderer, const Scene& scene, const Settings& measured, FrameRequest request,
                         CostCase cost, ReferenceCache& references, const Workers& workers)
    : renderer_(renderer), scene_(scene) {
    for (Settings& s : scripted_frames(scene, measured, double(request.width) / request.height, cost)) {
        trace_sources(renderer, scene, s, request, references, workers);
        frames_.push_back({std::move(s), request});
        set_timed_passes(frames_.back().request, cost);
    }
}

void TimedFrames::switch_off(OptimisationSet optimisations) {
    for (Frame& frame : frames_) frame.request.forced = optimisations;
}

FrameResult TimedFrames::draw_next() {
    const Frame& frame = frames_[next_++ % frames_.size()];
    return renderer_.render(scene_, frame.settings, frame.request);
}

void TimedFrames::warm_up() {
    draw_next();
    // The first frame draws everything; the next one shows cached results.
    if (frames_.size() > 1) draw_next();
}

TimedFrames Measurer::frames(const Scene& scene, const Settings& settings, CostCase cost) {
    return {renderer_,   scene,   measured_settings(settings), {.width = width_, .height = height_}, cost,
            references_, workers_};
}

TimeSamples Measurer::time(const Scene& scene, const Settings& settings, int frames, CostCase cost) {
    TimedFrames timed = this->frames(scene, settings, cost);
    TimeSamples samples;
    timed.warm_up();
    for (int i = 0; i < frames; ++i) samples.add(timed.draw_next());
    return samples;
}

TimeMeasurement Measurer::time(const Scene& scene, const Settings& settings, CostCase cost,
                               const TimeSampler::Limits& limits) {
    TimedFrames timed = frames(scene, settings, cost);
    if (cost != CostCase::Forced) timed.warm_up();
    TimeMeasurement m = sample_times(limits, [&] {
        if (workers_.stop.stop_requested()) throw Cancelled();
        return timed.draw_next();
    });
    m.cost = cost;
    return m;
}

}  // namespace si
