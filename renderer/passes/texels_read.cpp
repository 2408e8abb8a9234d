// Pass that marks the texels of the shown map which the kernels of all pixels fetch.
#include "renderer/passes/texels_read.h"

#include "renderer/passes/moments.h"

namespace si {

void TexelsReadPass::declare(FrameState& f) {
    Pass pass{.name = "texels read",
              .category = PassCategory::Tool,
              .reads = kernel_inputs(f),
              .writes = {Result::TexelsRead},
              .idle_reason = "not needed: no output shows which texels are read"};
    pass.reads.push_back(Result::VisibleSurfaces);
    int layer = 0;
    if (!f.shown_view(&layer)) {
        f.plan.release_later([this] { targets_ = {}; });
        return f.plan.skip_pass(std::move(pass), "view.light has no shadow map");
    }
    f.plan.place_result(Result::TexelsRead, {&targets_.marks});
    pass.key = f.shown_light_key().add(layer).value();
    pass.cached = &targets_.marks.key;
    pass.run = [this, &f, layer](PassInfo& info) { run(f, layer, info); };
    f.plan.add_pass(std::move(pass));
}

void TexelsReadPass::run(const FrameState& f, int layer, PassInfo& info) {
    Targets& t = targets_;
    t.marks.ensure("texels read", GL_R32F, f.map_size.width, f.map_size.height);
    t.nothing.ensure("nothing", GL_R8, f.request.width, f.request.height);
    const float none = 0;
    glClearTexImage(t.marks.texture.id(), 0, GL_RED, GL_FLOAT, &none);
    const gl::Framebuffer framebuffer = f.begin_fullscreen_pass("texels read", t.nothing);
    glBindImageTexture(shared::IMAGE_TEXELS_READ, t.marks.texture.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    f.use_fullscreen("passes/texels_read.frag.glsl", {{"LIGHT_INDEX", std::to_string(f.settings.view.light)},
                                                      {"MARK_TEXELS", std::to_string(layer)},
                                                      {"FILTER_SAMPLER", "0"},
                                                      {"COMPARE_BY_HAND", "1"}});
    FrameState::draw_fullscreen(info);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace si
