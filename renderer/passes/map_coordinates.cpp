// Where in the shown light's map each pixel's kernel is centred.
#include <algorithm>

#include "renderer/frame/state.h"

namespace si {

void add_map_coordinates_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "map coordinates";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::MapCoordinates};
    pass.idle_reason = "nobody asks which texels are read";
    if (!f.shown_view()) {
        pass.unneeded = "the light shown has no map";
        plan.push_back(std::move(pass));
        return;
    }
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.lights_key).add(f.settings.view.light).add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.map_coordinates.key;
    pass.run = [&f](PassInfo& info) {
        f.gl.map_coordinates.ensure("map coordinates", GL_RGBA32F, f.request.width, f.request.height);
        f.gl.map_coordinates_framebuffer =
            gl::make_framebuffer("map coordinates", &f.gl.map_coordinates, &f.gl.camera_depth);
        const GLuint framebuffer = f.gl.map_coordinates_framebuffer.id();
        f.begin_camera_pass(framebuffer);
        const glm::vec4 nothing(0);
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &nothing.x);
        const int last = std::max(int(f.gl.fitted.size()) - 1, 0);
        const int light = std::clamp(f.settings.view.light, 0, last);
        f.draw_from_camera("passes/map_coordinates.frag.glsl", {{"LIGHT_INDEX", std::to_string(light)}}, info);
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
