// The renderer's inside, shared by drawing, reading back and probing.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "renderer/frame/state.h"
#include "renderer/render/all_passes.h"

namespace si {

struct RendererImpl {
    DriverInfo driver;
    gl::MessageLog messages;
    std::unique_ptr<gl::PassClock> clock;  ///< made when first needed: calibrating costs a few frames
    Resources resources;
    AllPasses passes;
    const std::uint64_t number;  ///< no other renderer has it

    /// The settings of the last frame, as they were given and as they can be drawn.
    struct Repaired {
        Settings given, settings;
        std::vector<std::string> notes;
    };
    std::optional<Repaired> repaired;

    /// Maps that the driver had no memory for: those of this map.resolution are made no larger.
    struct MapLimit {
        int asked = 0, most = 0;
        std::string why;
    };
    std::optional<MapLimit> map_limit;
    std::function<void(const Settings&, const NumericHealth&)> watch;  ///< see Renderer::set_number_watcher()

    explicit RendererImpl(std::shared_ptr<gl::ProgramCache> programs = std::make_shared<gl::ProgramCache>());
    /// After the driver refused memory: has maps be half as large. @returns whether that may help
    bool reduce_map_limit(const Settings& asked, const FrameState& f, const std::string& why);
    /// Derives everything of a frame that needs no drawing, but for the depths that the camera sees, which are drawn
    /// and read back first where a fit asks for them.
    FrameState prepare_frame(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// As prepare_frame(), with the depths that are known.
    FrameState derive_frame_state(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// As Renderer::render(), unwatched.
    FrameResult render(const Scene& scene, const Settings& settings, const FrameRequest& request);
    /// Carries out the plan of a frame.
    FrameResult run_plan(FrameState& f);
    /// Adds the passes of a frame to its plan.
    void plan_frame(FrameState& f);
    /// Fills in what the frame drew and found out; `result` has the passes already.
    void describe_frame(FrameState& f, FrameResult& result);
    gl::PassClock& pass_clock();
    /// Measures the polygon offset of a map format (MapFormat), once.
    void calibrate_offset(MapFormat map_format);
};

/// What the passes of a frame left in its images.
FrameContents contents_of(const FrameState& f, const std::vector<PassInfo>& infos);

}  // namespace si
