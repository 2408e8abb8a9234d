// The lit picture. Evaluates visibility itself unless the visibility texture exists anyway.
#include <algorithm>

#include "renderer/passes/camera_pass.h"

namespace si {
namespace {

struct ShadedTargets {
    gl::Target picture, true_picture;
    gl::Target true_visibility;  ///< as Result::Visibility
};

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

/// @param separate visibility is bound, and not evaluated by the shader
void draw_picture(FrameState& f, gl::Target& target, bool separate, PassInfo& info) {
    std::vector<gl::Define> extra;
    if (separate) extra.push_back({"SEPARATE_VISIBILITY", "1"});
    CameraPass pass(f, "shaded picture", GL_RGBA8, target);
    pass.clear(kBackground);
    const auto draw = [&](const char* which) {
        std::vector<gl::Define> defines = extra;
        if (which) defines.push_back({which, "1"});
        pass.draw("passes/shade.frag.glsl", defines, info);
    };
    // The dim pass does by an alpha test and an equal depth what one shader could, so that it costs what it did.
    if (f.settings.shading.composition == int(Composition::DimLit))
        draw("DIM_PASS"), draw("LIT_PASS");
    else
        draw(nullptr);
    draw_blended(f, info);
}

}  // namespace

void add_true_shade_pass(FrameState& f) {
    ShadedTargets& t = f.gl.owned.get<ShadedTargets>();
    f.plan.place(Result::TruePicture, {&t.true_picture});
    Pass pass;
    pass.name = "shading by the truth";
    pass.reads = lookup_reads(f);
    pass.reads.push_back(Result::Visibility);
    pass.category = PassCategory::Tool;
    pass.writes = {Result::TruePicture};
    pass.idle_reason = "not needed: the true picture is not shown";
    if (!f.truth.met) {
        pass.unneeded = "the truth about this frame is not traced";
        f.plan.add(std::move(pass));
        return;
    }
    pass.key = f.shown_light_key().add(f.truth.key).value();
    pass.cached = &t.true_picture.key;
    pass.run = [&f, &t](PassInfo& info) {
        const gl::Target& drawn = f.result(Result::Visibility);
        gl::Target& visibility = t.true_visibility;
        visibility.ensure("visibility by the truth", drawn.format, drawn.width, drawn.height, drawn.layers);
        glCopyImageSubData(drawn.texture.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, visibility.texture.id(),
                           GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, drawn.width, drawn.height, drawn.layers);
        put_traced_visibility(*f.request.truth, visibility, f.settings.view.light);
        glBindTextureUnit(shared::UNIT_VISIBILITY, visibility.texture.id());
        draw_picture(f, t.true_picture, true, info);
    };
    f.plan.add(std::move(pass));
}

void add_shade_pass(FrameState& f) {
    gl::Target& picture = f.gl.owned.get<ShadedTargets>().picture;
    f.plan.place(Result::Shaded, {&picture, shared::UNIT_SHADED});
    Pass pass;
    pass.name = f.separate_visibility ? "shading (reads visibility)" : "shading (with visibility)";
    pass.reads = lookup_reads(f);
    if (f.separate_visibility) pass.reads.push_back(Result::Visibility);
    pass.writes = {Result::Shaded};
    pass.idle_reason = "the picture was not asked for";
    pass.key = f.lighting_key().add(f.separate_visibility).value();
    pass.cached = &picture.key;
    pass.run = [&f, &picture](PassInfo& info) { draw_picture(f, picture, f.separate_visibility, info); };
    f.plan.add(std::move(pass));
}

}  // namespace si
