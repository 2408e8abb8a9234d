// Implementation of Renderer, shared by drawing, read-back and probing.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "renderer/bundle/given_maps.h"
#include "renderer/frame/state.h"
#include "renderer/render/all_passes.h"

namespace si {

/// State of a Renderer: properties of the driver, GPU resources, passes and memory limits.
struct RendererImpl {
    DriverInfo driver;
    gl::MessageLog messages;
    std::unique_ptr<gl::PassClock> clock;  ///< created when first needed, as calibration costs a few frames
    Resources resources;
    AllPasses passes;
    const std::uint64_t number;  ///< unique number of this renderer

    /// Settings of the last frame: as given, and after repair to drawable values.
    struct Repaired {
        Settings given, settings;
        std::vector<std::string> notes;
    };
    std::optional<Repaired> repaired;

    /// Reduced map resolution after the driver ran out of memory. Applies while map.resolution keeps the value it had
    /// then.
    struct ReducedResolution {
        int requested = 0, max = 0;  ///< map.resolution of the settings; largest resolution tried
        std::string why;
    };
    std::optional<ReducedResolution> reduced_resolution;

    /// Maps of map.bundle, moved with the scene.
    struct PlacedBundle {
        std::shared_ptr<const GivenMaps> given;
        glm::dmat4 placement{1};
        std::vector<std::shared_ptr<const ImportedMaps>> lights;
    };
    PlacedBundle bundle;
    std::function<void(const Settings&, const NumericHealth&)> watch;  ///< see Renderer::set_number_watcher()

    /// Queries the driver and creates the GPU resources in the current context.
    /// @param programs shader program cache, not null
    /// @throws Error when the context lacks OpenGL 4.5
    RendererImpl();
    /// Halves the map resolution after the driver ran out of memory. Returns true when drawing again may succeed.
    /// @param why the message of the failure
    bool reduce_map_limit(const Settings& settings, const FrameState& f, const std::string& why);
    /// Derives all values that a frame's passes read: repaired settings, camera, fitted lights, needs of its outputs.
    /// Draws nothing except the visible depths, where a fit of light.depth_bounds needs them.
    FrameState prepare_frame(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Derives the values of a frame as prepare_frame() does, from the visible depths measured so far.
    FrameState derive_frame_state(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Puts the maps of map.bundle into the frame's request, unless it has maps of its own. @throws Error for a bundle
    /// that cannot be read
    void take_bundle_maps(FrameState& f);
    /// Draws one frame for Renderer::render(), which may then call `watch`, the callback that receives invalid numbers
    /// found in the frame.
    FrameResult render(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Runs the passes of a planned frame, and returns its result.
    FrameResult run_plan(FrameState& f);
    /// Lets all passes declare themselves in the frame's plan.
    void plan_frame(FrameState& f);
    /// Fills `result` with the frame's images, camera, lights and measured numbers.
    /// @param[in,out] result has the pass reports already
    void describe_frame(FrameState& f, FrameResult& result);
    /// Returns the clock that times passes, and calibrates it on the first call.
    gl::PassClock& pass_clock();
    /// Measures the driver's polygon offset for a map format, on the first call for this format.
    void calibrate_offset(MapFormat map_format);
};

/// Returns which images a frame's passes left in the renderer, with their keys.
FrameContents contents_of(const FrameState& f, const std::vector<PassInfo>& infos);

}  // namespace si
