// Where in the shown light's map each pixel's kernel is centred.
#include "renderer/passes/camera_pass.h"
#include "renderer/passes/passes.h"

namespace si {
namespace {

struct CoordinateTargets {
    gl::Target coordinates;
};

}  // namespace

void add_map_coordinates_pass(FrameState& f) {
    gl::Target& coordinates = f.gl.owned.get<CoordinateTargets>().coordinates;
    f.plan.place(Result::MapCoordinates, {&coordinates});
    Pass pass;
    pass.name = "map coordinates";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::MapCoordinates};
    pass.idle_reason = "not needed: nothing shows which texels are read";
    if (!f.shown_view()) {
        pass.unneeded = "the light shown has no map";
        f.plan.add(std::move(pass));
        return;
    }
    pass.key = f.shown_light_key().value();
    pass.cached = &coordinates.key;
    pass.run = [&f, &coordinates](PassInfo& info) {
        CameraPass(f, "map coordinates", GL_RGBA32F, coordinates)
            .clear(glm::vec4(0))
            .draw("passes/map_coordinates.frag.glsl", {{"LIGHT_INDEX", std::to_string(f.settings.view.light)}}, info);
    };
    f.plan.add(std::move(pass));
}

}  // namespace si
