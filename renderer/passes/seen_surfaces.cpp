// The surfaces that the camera sees, pixel by pixel, for passes that evaluate some of them again.
#include "renderer/frame/state.h"

namespace si {

void add_seen_surfaces_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "surfaces seen";
    pass.writes = {"surfaces seen"};
    pass.idle_reason = "nothing evaluates pixels again";
    Key key = f.camera_depth_key();
    pass.key = key.add(f.settings.bias.normal_source).value();
    pass.cached = &f.gl.seen[0].key;
    pass.run = [&f](PassInfo& info) {
        const bool own_normal = f.settings.bias.normal_source != int(NormalSource::Geometric);
        const int images = own_normal ? 3 : 2;
        if (!own_normal) f.gl.seen[2] = {};
        f.gl.seen_framebuffer = gl::Framebuffer::create("surfaces seen");
        const GLuint framebuffer = f.gl.seen_framebuffer.id();
        GLenum buffers[kSeenImages];
        for (int i = 0; i < images; ++i) {
            buffers[i] = GL_COLOR_ATTACHMENT0 + GLenum(i);
            gl::Target& t = f.gl.seen[std::size_t(i)];
            t.ensure("surfaces seen", GL_RGBA32F, f.request.width, f.request.height);
            glNamedFramebufferTexture(framebuffer, buffers[i], t.texture.id(), 0);
        }
        glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, f.gl.camera_depth.texture.id(), 0);
        glNamedFramebufferDrawBuffers(framebuffer, images, buffers);
        f.begin_camera_pass(framebuffer);
        // Where there is nothing, nobody reads.
        f.draw_from_camera("passes/seen_surfaces.frag.glsl", {}, info);
    };
    plan.push_back(std::move(pass));
}

void bind_seen_surfaces(const FrameState& f) {
    for (int i = 0; i < kSeenImages; ++i)
        glBindTextureUnit(GLuint(kSeenSurfaces + i), f.gl.seen[std::size_t(i)].texture.id());
}

}  // namespace si
