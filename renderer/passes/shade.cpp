// The lit picture. Evaluates visibility itself unless the visibility texture exists anyway.
#include <algorithm>

#include "renderer/frame_state.h"

namespace si {
namespace {

constexpr glm::vec4 kBackground(0.155f, 0.165f, 0.185f, 1.f);  // sRGB; calm, darker than any lit surface

void draw_blended(const FrameState& f, PassInfo& info) {
    std::vector<const Batch*> batches;
    for (const Batch& b : f.gl.scene->batches())
        if (b.blend) batches.push_back(&b);
    if (batches.empty()) return;
    const glm::dvec3 forward = -f.camera.axes[2];
    std::stable_sort(batches.begin(), batches.end(), [&](const Batch* a, const Batch* b) {
        return glm::dot(a->centre_ws - f.camera.eye, forward) > glm::dot(b->centre_ws - f.camera.eye, forward);
    });
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    for (const Batch* b : batches) {
        glUseProgram(f.batch_program("passes/scene.vert.glsl", "passes/shade.frag.glsl", {{"BLEND", "1"}}, *b, false));
        f.bind_textures(*b);
        b->double_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
        glFrontFace(b->mirrored ? GL_CW : GL_CCW);
        f.gl.scene->draw(*b);
        ++info.draws;
        info.triangles += b->triangles();
    }
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

}  // namespace

void add_shade_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = f.separate_visibility ? "shading (reads visibility)" : "shading (with visibility)";
    pass.reads = {f.separate_visibility ? "visibility" : "shadow maps", "shadow maps"};
    pass.writes = {"shaded"};
    pass.idle_reason = "the picture was not asked for";
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.lights_key).add(f.maps_key).add(f.separate_visibility);
    key.add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.shaded.key;
    pass.run = [&f](PassInfo& info) {
        f.gl.shaded.ensure("shaded picture", GL_RGBA8, f.request.width, f.request.height);
        f.gl.shaded_framebuffer = gl::make_framebuffer("shaded picture", &f.gl.shaded, &f.gl.camera_depth);
        const GLuint framebuffer = f.gl.shaded_framebuffer.id();
        f.begin_camera_pass(framebuffer);
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &kBackground.x);
        std::vector<gl::Define> extra;
        if (f.separate_visibility) {
            extra.push_back({"SEPARATE_VISIBILITY", "1"});
            glBindTextureUnit(kVisibility, f.gl.visibility.texture.id());
        }
        f.draw_from_camera("passes/shade.frag.glsl", extra, info);
        draw_blended(f, info);
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
