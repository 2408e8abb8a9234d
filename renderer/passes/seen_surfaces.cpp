// The surfaces that the camera sees, pixel by pixel, for passes that evaluate some of them again.
#include "renderer/frame/state.h"

namespace si {

void add_seen_surfaces_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "surfaces seen";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::SurfacesSeen};
    pass.idle_reason = "nothing evaluates pixels again";
    Key key = f.camera_depth_key();
    pass.key = key.add(f.settings.bias.normal_source).value();
    pass.cached = &f.gl.seen[0].key;
    pass.run = [&f](PassInfo& info) {
        const bool own_normal = f.settings.bias.normal_source != int(NormalSource::Geometric);
        const std::span<gl::Target> images = std::span(f.gl.seen).first(own_normal ? 3 : 2);
        if (!own_normal) f.gl.seen[2] = {};
        for (gl::Target& t : images) t.ensure("surfaces seen", GL_RGBA32F, f.request.width, f.request.height);
        f.gl.seen_framebuffer = gl::make_framebuffer("surfaces seen", images, f.gl.camera_depth);
        f.begin_camera_pass(f.gl.seen_framebuffer.id());
        // Where there is nothing, nobody reads.
        f.draw_from_camera("passes/seen_surfaces.frag.glsl", {}, info);
    };
    plan.push_back(std::move(pass));
}

void bind_seen_surfaces(std::span<const gl::Target, kSeenImages> seen) {
    for (std::size_t i = 0; i < seen.size(); ++i) glBindTextureUnit(GLuint(kSeenSurfaces + i), seen[i].texture.id());
}

}  // namespace si
