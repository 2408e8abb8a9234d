// The renderer's inside, shared by drawing, reading back and probing.
#pragma once

#include <memory>

#include "renderer/frame/state.h"

namespace si {

struct Renderer::Impl {
    DriverInfo driver;
    gl::MessageLog messages;
    std::unique_ptr<gl::PassClock> clock;  ///< made when first needed: calibrating costs a few frames
    Resources resources;

    Impl();
    /// Derives everything of a frame that needs no drawing.
    FrameState prepare(const Scene& scene, const Settings& settings, const FrameRequest& request);
    void upload_blocks(const FrameState& f);
    gl::PassClock& pass_clock();
    /// Measures the polygon offset of a map format (MapFormat), once.
    void calibrate_offset(int map_format);
};

/// Fills in what the frame drew and found out; `result` has the passes already.
void describe_frame(FrameState& f, FrameResult& result);

}  // namespace si
