// The camera's depth by itself, for what reads it: the map viewer and the texel slabs.
#include "renderer/frame/state.h"

namespace si {

void add_camera_depth_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "camera depth";
    pass.writes = {Result::CameraDepth};
    pass.idle_reason = "nothing reads it: each pass from the camera brings its own depth test";
    pass.key = f.camera_depth_key().value();
    pass.cached = &f.gl.depth_key;
    pass.run = [&f](PassInfo& info) {
        f.gl.camera_depth_framebuffer = gl::make_framebuffer("camera depth", nullptr, &f.gl.camera_depth);
        f.gl.depth_key = 0;
        f.begin_camera_pass(f.gl.camera_depth_framebuffer.id());
        f.draw_from_camera("passes/camera_depth.frag.glsl", {}, info);
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
