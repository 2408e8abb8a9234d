// The chosen overlay's values, and the picture with the overlay over it.
#include <algorithm>

#include "renderer/frame_state.h"

namespace si {
namespace {

std::vector<gl::Define> overlay_defines(const FrameState& f) {
    const int last = std::max(int(f.gl.fitted.size()) - 1, 0);
    std::vector<gl::Define> out{{"LIGHT_INDEX", std::to_string(std::clamp(f.settings.view.light, 0, last))}};
    if (f.overlay()->scalar) out.push_back({"OVERLAY_SCALAR", "1"});
    if (f.separate_visibility) out.push_back({"SEPARATE_VISIBILITY", "1"});
    return out;
}

Pass values_pass(FrameState& f) {
    Pass pass;
    pass.name = "overlay values";
    pass.reads = {"shadow maps"};
    if (f.separate_visibility) pass.reads.push_back("visibility");
    pass.writes = {"overlay"};
    pass.idle_reason = "the overlay was not asked for";
    if (!f.overlay()) {
        pass.unneeded = "no overlay is chosen";
        return pass;
    }
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.lights_key).add(f.maps_key).add(f.settings.view.overlay).add(f.settings.view.light);
    key.add(f.settings.view.face).add(f.separate_visibility).add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.overlay.key;
    pass.run = [&f](PassInfo& info) {
        f.gl.overlay.ensure("overlay values", GL_RGBA32F, f.request.width, f.request.height);
        f.gl.overlay_framebuffer = gl::make_framebuffer("overlay values", &f.gl.overlay, &f.gl.camera_depth);
        const GLuint framebuffer = f.gl.overlay_framebuffer.id();
        f.begin_camera_pass(framebuffer);
        const glm::vec4 nothing(0);
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &nothing.x);
        if (f.separate_visibility) glBindTextureUnit(kVisibility, f.gl.visibility.texture.id());
        f.draw_from_camera("passes/overlay.frag.glsl", overlay_defines(f), info);
    };
    return pass;
}

Pass compose_pass(FrameState& f, std::uint64_t values_key, std::uint64_t shaded_key) {
    Pass pass;
    pass.name = "overlay over picture";
    pass.reads = {"shaded", "overlay"};
    pass.writes = {"composed"};
    pass.idle_reason = "the picture was not asked for";
    if (!f.overlay()) {
        pass.unneeded = "no overlay is chosen";
        return pass;
    }
    const ViewSettings& v = f.settings.view;
    const Overlay& row = *f.overlay();
    const float lo = float(v.overlay_range != int(OverlayRange::Manual) ? row.min : v.overlay_min);
    const float hi = float(v.overlay_range != int(OverlayRange::Manual) ? row.max : v.overlay_max);
    Key key;
    key.add(values_key).add(shaded_key).add(lo).add(hi).add(v.overlay_opacity);
    pass.key = key.value();
    pass.cached = &f.gl.composed.key;
    pass.run = [&f, lo, hi](PassInfo& info) {
        f.gl.composed.ensure("picture with overlay", GL_RGBA8, f.request.width, f.request.height);
        f.gl.composed_framebuffer = gl::make_framebuffer("picture with overlay", &f.gl.composed, nullptr);
        f.begin_fullscreen_pass(f.gl.composed_framebuffer.id(), f.request.width, f.request.height);
        const GLuint id = f.program("passes/fullscreen.vert.glsl", "passes/compose.frag.glsl");
        glUseProgram(id);
        glBindTextureUnit(kShaded, f.gl.shaded.texture.id());
        glBindTextureUnit(kOverlayValues, f.gl.overlay.texture.id());
        glUniform4f(glGetUniformLocation(id, "scale"), lo, hi, float(f.settings.view.overlay_opacity),
                    f.overlay()->diverging ? 1.f : 0.f);
        glUniform1i(glGetUniformLocation(id, "scalar"), f.overlay()->scalar);
        FrameState::draw_fullscreen(info);
    };
    return pass;
}

}  // namespace

void add_overlay_passes(FrameState& f, std::vector<Pass>& plan) {
    Pass values = values_pass(f);
    const std::uint64_t shaded_key = plan.back().key;  // the shading pass stands just before
    Pass compose = compose_pass(f, values.key, shaded_key);
    plan.push_back(std::move(values));
    plan.push_back(std::move(compose));
}

}  // namespace si
