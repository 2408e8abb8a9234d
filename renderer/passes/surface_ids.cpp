// Pass that stores object and triangle of each pixel.
#include "renderer/passes/surface_ids.h"

#include "renderer/passes/camera_pass.h"

namespace si {

void SurfaceIdsPass::declare(FrameState& f) {
    f.plan.place_result(Result::SurfaceIds, {&ids_});
    Pass pass;
    pass.name = "surface ids";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::SurfaceIds};
    pass.idle_reason = "not needed: no pass reads triangle numbers";
    pass.key = f.surfaces_key().value();
    pass.cached = &ids_.key;
    pass.run = [this, &f](PassInfo& info) { run(f, info); };
    f.plan.add_pass(std::move(pass));
}

void SurfaceIdsPass::run(FrameState& f, PassInfo& info) {
    // The object's number is passed along with the surface flags.
    CameraPass(f, "surface ids", GL_RG32UI, ids_)
        .clear(glm::uvec4(0))
        .draw("passes/surface_ids.frag.glsl", {{"SURFACE_FLAGS", "1"}}, info);
}

}  // namespace si
