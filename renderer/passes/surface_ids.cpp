// Which triangle of which object each pixel shows, for whoever needs the surface itself.
#include "renderer/passes/camera_pass.h"
#include "renderer/passes/passes.h"

namespace si {
namespace {

struct SurfaceIdTargets {
    gl::Target ids;  ///< RG32UI
};

}  // namespace

void add_surface_ids_pass(FrameState& f) {
    gl::Target& ids = f.gl.owned.get<SurfaceIdTargets>().ids;
    f.plan.place(Result::SurfaceIds, {&ids});
    Pass pass;
    pass.name = "surface ids";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::SurfaceIds};
    pass.idle_reason = "not needed: nothing reads which triangle a pixel shows";
    pass.key = f.surfaces_key().value();
    pass.cached = &ids.key;
    pass.run = [&f, &ids](PassInfo& info) {
        // The object's number travels with the flags.
        CameraPass(f, "surface ids", GL_RG32UI, ids)
            .clear(glm::uvec4(0))
            .draw("passes/surface_ids.frag.glsl", {{"SURFACE_FLAGS", "1"}}, info);
    };
    f.plan.add(std::move(pass));
}

}  // namespace si
