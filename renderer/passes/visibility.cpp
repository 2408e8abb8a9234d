// Visibility of each light as a texture of its own.
#include "renderer/frame/state.h"

namespace si {

void add_visibility_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "visibility";
    pass.reads = lookup_reads(f);
    pass.writes = {"visibility"};
    pass.idle_reason = "nothing reads it: the shading pass evaluates it itself";
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.lights_key).add(f.maps_key).add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.visibility.key;
    pass.run = [&f](PassInfo& info) {
        const int layers = int(std::max<std::size_t>(f.gl.fitted.size(), 1));
        f.gl.visibility.ensure("visibility", GL_R32F, f.request.width, f.request.height, layers);
        for (int light = 0; light < layers; ++light) {
            f.gl.visibility_framebuffer =
                gl::make_framebuffer("visibility", &f.gl.visibility, &f.gl.camera_depth, light);
            const GLuint framebuffer = f.gl.visibility_framebuffer.id();
            const std::uint64_t depth = f.gl.depth_key;
            f.begin_camera_pass(framebuffer);
            const glm::vec4 lit(1);
            glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &lit.x);
            // A light without shadows leaves every pixel lit; there is nothing to evaluate.
            const bool casts = std::size_t(light) < f.gl.fitted.size() && f.gl.fitted[std::size_t(light)].casts;
            if (!casts && !f.request.no_skip) {
                if (f.gl.depth_key != depth) f.gl.depth_key = 0;  // cleared, and nothing drawn
                continue;
            }
            f.draw_from_camera("passes/visibility.frag.glsl", {{"LIGHT_INDEX", std::to_string(light)}}, info);
        }
        f.gl.visibility_view_layer = -1;
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
