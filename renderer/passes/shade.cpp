// The lit picture. Evaluates visibility itself unless the visibility texture exists anyway.
#include <algorithm>

#include "renderer/frame/state.h"

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

/// @param visibility a layer a light; null: evaluated by the shader
void draw_picture(FrameState& f, gl::Target& target, gl::Framebuffer& framebuffer, const gl::Target* visibility,
                  PassInfo& info) {
    target.ensure("shaded picture", GL_RGBA8, f.request.width, f.request.height);
    framebuffer = gl::make_framebuffer("shaded picture", &target, &f.gl.camera_depth);
    f.begin_camera_pass(framebuffer.id());
    glClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, &kBackground.x);
    std::vector<gl::Define> extra;
    if (visibility) {
        extra.push_back({"SEPARATE_VISIBILITY", "1"});
        glBindTextureUnit(kVisibility, visibility->texture.id());
    }
    f.draw_from_camera("passes/shade.frag.glsl", extra, info);
    draw_blended(f, info);
}

}  // namespace

void add_true_shade_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "shading by the truth";
    pass.reads = lookup_reads(f);
    pass.reads.push_back(Result::Visibility);
    pass.category = PassCategory::Tool;
    pass.writes = {Result::TruePicture};
    pass.idle_reason = "nobody asks for the true picture";
    if (!f.truth.met) {
        pass.unneeded = "the truth about this frame is not traced";
        plan.push_back(std::move(pass));
        return;
    }
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.lights_key).add(f.maps_key).add(f.truth.key);
    key.add(f.settings.view.light).add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.true_shaded.key;
    pass.run = [&f](PassInfo& info) {
        const gl::Target& drawn = f.gl.visibility;
        gl::Target& visibility = f.gl.true_visibility;
        visibility.ensure("visibility by the truth", drawn.format, drawn.width, drawn.height, drawn.layers);
        glCopyImageSubData(drawn.texture.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, visibility.texture.id(),
                           GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, drawn.width, drawn.height, drawn.layers);
        put_traced_visibility(*f.request.truth, visibility, f.settings.view.light);
        draw_picture(f, f.gl.true_shaded, f.gl.true_shaded_framebuffer, &visibility, info);
    };
    plan.push_back(std::move(pass));
}

void add_shade_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = f.separate_visibility ? "shading (reads visibility)" : "shading (with visibility)";
    pass.reads = lookup_reads(f);
    if (f.separate_visibility) pass.reads.push_back(Result::Visibility);
    pass.writes = {Result::Shaded};
    pass.idle_reason = "the picture was not asked for";
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.lights_key).add(f.maps_key).add(f.separate_visibility);
    key.add(f.gl.programs.source().generation());
    pass.key = key.value();
    pass.cached = &f.gl.shaded.key;
    pass.run = [&f](PassInfo& info) {
        draw_picture(f, f.gl.shaded, f.gl.shaded_framebuffer, f.separate_visibility ? &f.gl.visibility : nullptr, info);
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
