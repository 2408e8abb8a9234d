// Implementation of Renderer, shared by drawing, read-back and probing.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "renderer/bundle/given_maps.h"
#include "renderer/frame/state.h"
#include "renderer/render/all_passes.h"

namespace si {

/// Private state of a Renderer: properties of the driver, GPU resources, passes and memory limits.
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

    /// Limit on the map resolution after the driver ran out of memory. Valid while the setting map.resolution keeps the
    /// value at which memory ran out.
    struct ReducedResolution {
        int requested = 0, max = 0;  ///< map.resolution when memory ran out; largest resolution to try
        std::string why;
    };
    std::optional<ReducedResolution> reduced_resolution;

    /// Imported shadow maps of the bundle (an engine's frame as files) that map.bundle names, transformed like the
    /// scene.
    struct PlacedBundle {
        std::shared_ptr<const GivenMaps> given;
        glm::dmat4 placement{1};
        std::vector<std::shared_ptr<const ImportedMaps>> lights;
    };
    PlacedBundle bundle;
    std::function<void(const Settings&, const NumericHealth&)> watch;  ///< see Renderer::set_number_watcher()

    /// Queries the driver and creates the GPU resources in the current context.
    /// @throws Error when the context lacks OpenGL 4.5
    RendererImpl();
    /// Halves the limit on the map resolution after the driver ran out of memory. Returns true when drawing the frame
    /// again may succeed. Removes the limit and returns false when smaller maps would not help: no map is drawn,
    /// imported maps fix the size, or the maps are so small already that they need little memory.
    /// @param f frame that failed
    /// @param why message of the failure
    bool reduce_map_limit(const Settings& settings, const FrameState& f, const std::string& why);
    /// Derives all values that the passes of a frame read: settings repaired to drawable values, camera, fitted lights,
    /// and the results that the frame's outputs need. Draws nothing except the visible depths, where a fit by
    /// light.depth_bounds sdsm needs them.
    FrameState prepare_frame(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Derives the values of a frame like prepare_frame(), but measures nothing: uses the visible depths of an earlier
    /// measurement.
    FrameState derive_frame_state(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Puts the shadow maps of map.bundle (an engine's frame as files) into the frame's request, unless the request has
    /// imported maps already.
    /// @throws Error for a bundle that cannot be read
    void take_bundle_maps(FrameState& f);
    /// Draws one frame for Renderer::render(): prepares it, plans its passes and runs them. When memory runs out, tries
    /// again with smaller shadow maps.
    /// @throws Error when memory runs out even so
    FrameResult render(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Draws the passes of a planned frame that are neither cached nor skipped, and returns the frame's result.
    FrameResult run_plan(FrameState& f);
    /// Lets all passes of the renderer add themselves to the frame's plan. Draws nothing.
    void plan_frame(FrameState& f);
    /// Fills in the result of a drawn frame: images, camera, lights and measured numbers.
    /// @param[in,out] result contains the pass reports already
    void describe_frame(FrameState& f, FrameResult& result);
    /// Returns the clock that times passes. The first call creates and calibrates the clock.
    gl::PassClock& pass_clock();
    /// Measures the driver's polygon offset for a map format, on the first call for this format.
    void calibrate_offset(MapFormat map_format);
};

/// Returns a record of the images that a frame's passes left in the renderer, with their cache keys.
/// @param infos reports on the passes
FrameContents contents_of(const FrameState& f, const std::vector<PassInfo>& infos);

}  // namespace si
