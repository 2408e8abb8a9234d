// The shadow map as a picture for people.
#include <algorithm>

#include "renderer/frame_state.h"

namespace si {

void add_map_view_pass(FrameState& f, std::vector<Pass>& plan) {
    static constexpr int kLargestPicture = 4096;
    Pass pass;
    pass.name = "map viewer";
    pass.reads = {"shadow maps"};
    pass.writes = {"map view"};
    pass.idle_reason = "the map viewer is closed";
    const ViewSettings& v = f.settings.view;
    const FittedLight* light =
        std::size_t(v.light) < f.gl.fitted.size() ? &f.gl.fitted[std::size_t(v.light)] : nullptr;
    if (!light || !light->casts) {
        pass.unneeded = light ? light->reason : "there is no such light";
        plan.push_back(std::move(pass));
        return;
    }
    const int face = std::min(v.face, int(light->views.size()) - 1);
    const LightView& view = light->views[std::size_t(face)];
    const int layer = f.first_view[std::size_t(v.light)] + face;
    Key key = f.maps_key;
    key.add(layer).add(v.map).add(v.map_black).add(v.map_white).add(v.band_low).add(v.band_high);
    key.add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.map_view.key;
    f.gl.shown = {MapSource::Light, v.light, face};
    pass.run = [&f, layer, &view](PassInfo& info) {
        const int size = std::min(f.map_resolution, kLargestPicture);
        f.gl.map_view.ensure("map viewer", GL_RGBA8, size, size);
        f.gl.map_view_framebuffer = gl::make_framebuffer("map viewer", &f.gl.map_view, nullptr);
        f.begin_fullscreen_pass(f.gl.map_view_framebuffer.id(), size, size);
        f.bind_maps();
        const GLuint id = f.program("passes/fullscreen.vert.glsl", "passes/map_view.frag.glsl");
        glUseProgram(id);
        const ViewSettings& s = f.settings.view;
        glUniform1i(glGetUniformLocation(id, "layer"), layer);
        glUniform1i(glGetUniformLocation(id, "mode"), s.map);
        glUniform4f(glGetUniformLocation(id, "curve"), float(view.curve.near), float(view.curve.far),
                    view.curve.perspective ? 1.f : 0.f, 0.f);
        glUniform4f(glGetUniformLocation(id, "range"), float(s.map_black), float(s.map_white), float(s.band_low),
                    float(s.band_high));
        FrameState::draw_fullscreen(info);
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
