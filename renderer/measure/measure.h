// Measurement of shadow error and frame time under given settings, shared by `measure`, sweeps and the editor.
#pragma once

#include "renderer/measure/measured_error.h"
#include "renderer/measure/time_sampler.h"
#include "renderer/render/renderer.h"

namespace si {

/// Comparison of a frame with the ray-traced reference of the light view.light: error metrics, work of the frame
/// (texels, bytes, draw calls, triangles), and pictures.
struct Classification {
    ErrorMetrics error;
    std::shared_ptr<const Reference> reference;
    WorkCost cost;
    int map_resolution = 0;                   ///< texels per side, as drawn
    std::optional<PageFacts> pages;           ///< pages of virtual maps, all drawn again; none: maps are whole
    std::vector<FittedLight> lights;          ///< lights of the frame
    ByteImage picture;                        ///< the frame
    ByteImage artefacts;                      ///< the frame in grey with wrong pixels in colour
    std::vector<ClassifiedPixel> classified;  ///< one per pixel of the reference, top row first
    std::vector<std::string> notes;           ///< warnings of the renderer, such as repaired settings
};

/// Sequence of frames under the same settings, drawn to be timed. CostCase says whether every pass is drawn again, the
/// camera moves or a light moves.
class TimedFrames {
public:
    /// Prepares the frames, and traces rays for lights whose source (light.source) is ray tracing or a light map.
    /// @param scene scene to draw; must outlive the object @param measured the settings from measured_settings()
    /// @throws Error, Cancelled
    TimedFrames(Renderer& renderer, const Scene& scene, const Settings& measured, FrameRequest request, CostCase cost,
                ReferenceCache& references, const Workers& workers);
    /// Switches optimisations off in all frames of the sequence, so that the work that they skip is drawn.
    void switch_off(OptimisationSet optimisations);
    /// Draws the next frame of the timed sequence and returns its pass times.
    FrameResult draw_next();
    /// Draws frames without timing them until cached results are valid again. Call after the renderer has drawn frames
    /// with other settings.
    void warm_up();

private:
    /// Settings and request of one frame of a timed sequence.
    struct Frame {
        Settings settings;
        FrameRequest request;
    };
    Renderer& renderer_;
    const Scene& scene_;
    std::vector<Frame> frames_;
    std::size_t next_ = 0;
};

/// Measurer of the shadow error and frame time of settings, for pictures of one size. Keeps traced references for the
/// next measurement. Use on the renderer's thread.
class Measurer {
public:
    /// Makes a measurer for pictures of this size in pixels.
    Measurer(Renderer& renderer, int width, int height, Workers workers = {})
        : renderer_(renderer), width_(width), height_(height), workers_(std::move(workers)) {}

    /// Sets the threads for tracing, with their stop token and progress report.
    void set_workers(Workers workers) { workers_ = std::move(workers); }

    /// Draws a frame, traces its reference by rays unless it is cached, and classifies the shadow error of each pixel.
    /// Used to measure the error of settings. @throws Error, Cancelled
    Classification classify(const Scene& scene, const Settings& settings);
    /// Draws and times a fixed number of frames, after some frames that only warm up caches. Returns the time of each
    /// frame.
    /// @param cost kind of frames to time: every pass drawn again, moving camera or moving light @throws Error,
    /// Cancelled
    TimeSamples time(const Scene& scene, const Settings& settings, int frames, CostCase cost);
    /// Times frames until the median time is precise enough or the limit of frames is reached. @throws Error, Cancelled
    TimeMeasurement time(const Scene& scene, const Settings& settings, CostCase cost,
                         const TimeSampler::Limits& limits = {});
    /// Prepares a sequence of frames with these settings, for callers that draw and time the frames one by one.
    /// @param cost kind of frames to time: every pass drawn again, moving camera or moving light
    TimedFrames frames(const Scene& scene, const Settings& settings, CostCase cost);
    /// Returns the cache of the traced references, so that a search after classify() does not trace them again.
    ReferenceCache& references() { return references_; }

private:
    Renderer& renderer_;
    int width_, height_;
    Workers workers_;
    ReferenceCache references_;
};

}  // namespace si
