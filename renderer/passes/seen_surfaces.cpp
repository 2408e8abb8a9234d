// Pass that stores the visible surface of each pixel, for passes that evaluate pixels again.
#include "renderer/passes/seen_surfaces.h"

#include "renderer/passes/camera_pass.h"
#include "renderer/settings/biases.h"

namespace si {

void VisibleSurfacesPass::declare(FrameState& f) {
    for (int i = 0; i < kVisibleSurfaceImages; ++i)
        f.plan.place_result(Result::VisibleSurfaces, {&images_[std::size_t(i)], shared::UNIT_SEEN_SURFACES + i});
    Pass pass;
    pass.name = "visible surfaces";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::VisibleSurfaces};
    pass.idle_reason = "no pass evaluates pixels again";
    // The image of the shading normal exists even where the normal has no effect.
    const bool own_normal = f.settings.bias.normal_source != NormalSource::Geometric;
    const bool steps = bias_of(f.settings).by_derivatives;
    const std::size_t count = steps ? 5 : own_normal ? 3 : 2;
    pass.key = f.with_settings(f.surfaces_key(), ReadBy::SurfacesSeen).add(count).value();
    pass.cached = &images_[0].key;
    pass.run = [this, &f, count](PassInfo& info) { run(f, count, info); };
    f.plan.add_pass(std::move(pass));
}

void VisibleSurfacesPass::run(FrameState& f, std::size_t count, PassInfo& info) {
    for (gl::Target& unused : std::span(images_).subspan(count)) unused = {};
    CameraPass(f, "visible surfaces", GL_RGBA32F, std::span(images_).first(count))
        .clear(glm::vec4(0))  // empty pixels receive no shadow
        .draw("passes/seen_surfaces.frag.glsl", {}, info);
}

void bind_visible_surfaces(std::span<const gl::Target, kVisibleSurfaceImages> seen) {
    for (std::size_t i = 0; i < seen.size(); ++i)
        glBindTextureUnit(GLuint(shared::UNIT_SEEN_SURFACES + i), seen[i].texture.id());
}

}  // namespace si
