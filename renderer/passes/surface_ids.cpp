// Which triangle of which object each pixel shows, for whoever needs the surface itself.
#include "renderer/frame/state.h"

namespace si {

void add_surface_ids_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "surface ids";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::SurfaceIds};
    pass.idle_reason = "nobody asks which triangle a pixel shows";
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.surface_ids.key;
    pass.run = [&f](PassInfo& info) {
        f.gl.surface_ids.ensure("surface ids", GL_RG32UI, f.request.width, f.request.height);
        f.gl.surface_ids_framebuffer = gl::make_framebuffer("surface ids", &f.gl.surface_ids, &f.gl.camera_depth);
        const GLuint framebuffer = f.gl.surface_ids_framebuffer.id();
        f.begin_camera_pass(framebuffer);
        const glm::uvec4 nothing(0);
        glClearNamedFramebufferuiv(framebuffer, GL_COLOR, 0, &nothing.x);
        // The object's number travels with the flags.
        f.draw_from_camera("passes/surface_ids.frag.glsl", {{"SURFACE_FLAGS", "1"}}, info);
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
