// The surfaces that the camera sees, pixel by pixel, for passes that evaluate some of them again.
#include "renderer/passes/camera_pass.h"
#include "renderer/settings/biases.h"

namespace si {
namespace {

struct SeenSurfaces {
    std::array<gl::Target, kSeenImages> images;  ///< RGBA32F; the key of all is the first one's
};

}  // namespace

void add_seen_surfaces_pass(FrameState& f) {
    std::array<gl::Target, kSeenImages>& images = f.gl.owned.get<SeenSurfaces>().images;
    for (int i = 0; i < kSeenImages; ++i)
        f.plan.place(Result::SurfacesSeen, {&images[std::size_t(i)], shared::UNIT_SEEN_SURFACES + i});
    Pass pass;
    pass.name = "surfaces seen";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::SurfacesSeen};
    pass.idle_reason = "nothing evaluates pixels again";
    // There is an image more also where its normal is without effect.
    const bool own_normal = f.settings.bias.normal_source != NormalSource::Geometric;
    const bool steps = bias_of(f.settings).by_derivatives;
    const std::size_t count = steps ? 5 : own_normal ? 3 : 2;
    pass.key = f.with_settings(f.surfaces_key(), ReadBy::SurfacesSeen).add(count).value();
    pass.cached = &images[0].key;
    pass.run = [&f, &images, count](PassInfo& info) {
        for (gl::Target& unused : std::span(images).subspan(count)) unused = {};
        CameraPass(f, "surfaces seen", GL_RGBA32F, std::span(images).first(count))
            .clear(glm::vec4(0))  // where there is nothing, nothing receives
            .draw("passes/seen_surfaces.frag.glsl", {}, info);
    };
    f.plan.add(std::move(pass));
}

void bind_seen_surfaces(std::span<const gl::Target, kSeenImages> seen) {
    for (std::size_t i = 0; i < seen.size(); ++i)
        glBindTextureUnit(GLuint(shared::UNIT_SEEN_SURFACES + i), seen[i].texture.id());
}

}  // namespace si
