// What one setting gets wrong, and what it costs: the one place where a frame is judged and timed, for `measure`,
// sweeps and the editor.
#pragma once

#include "renderer/measure/measured_error.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/render/renderer.h"

namespace si {

/// A frame held against the truth about view.light.
struct Classification {
    ErrorMetrics error;
    std::shared_ptr<const Reference> reference;  ///< that it was held against
    WorkCost cost;
    int map_resolution = 0;          ///< as drawn
    std::optional<PageFacts> pages;  ///< of virtual maps, all drawn anew
    ByteImage picture;               ///< as the frame shows it
    ByteImage artefacts;             ///< the picture in grey with what is wrong in colour
    std::vector<std::string> notes;  ///< of the renderer, such as repaired settings
};

/// Frames of one setting that are drawn to be timed, each following the one before it.
class TimedFrames {
public:
    /// Traces what the sources of visibility ask for. @param scene that lives longer @throws Error, Cancelled
    TimedFrames(Renderer& renderer, const Scene& scene, const Settings& measured, FrameRequest request, CostCase cost,
                ReferenceCache& references, const Workers& workers);
    FrameResult next();
    /// After another setting was drawn: what these frames keep is there again.
    void warm_up();

private:
    struct Frame {
        Settings settings;
        FrameRequest request;
    };
    Renderer& renderer_;
    const Scene& scene_;
    std::vector<Frame> frames_;
    std::size_t next_ = 0;
};

class Measurer {
public:
    /// @param width, height of the picture in pixels
    Measurer(Renderer& renderer, int width, int height, Workers workers = {})
        : renderer_(renderer), width_(width), height_(height), workers_(std::move(workers)) {}

    /// Who traces from now on, and may stop it.
    void set_workers(Workers workers) { workers_ = std::move(workers); }

    /// Draws, traces (unless the truth is known from before) and compares. @throws Error, Cancelled
    Classification judge(const Scene& scene, const Settings& settings);
    /// Draws what warms up, and `frames` that count. @throws Error
    TimeSamples time(const Scene& scene, const Settings& settings, int frames, CostCase cost);
    /// Draws until the time stands still or the most frames were drawn. @throws Error, Cancelled
    TimeMeasurement time(const Scene& scene, const Settings& settings, CostCase cost,
                         const TimeSampler::Limits& limits = {});
    /// Frames of these settings at this size.
    TimedFrames frames(const Scene& scene, const Settings& settings, CostCase cost);

private:
    Renderer& renderer_;
    int width_, height_;
    Workers workers_;
    ReferenceCache references_;
};

}  // namespace si
