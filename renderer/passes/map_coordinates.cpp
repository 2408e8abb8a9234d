// Pass that draws the map coordinates of each pixel's kernel centre, for view.light.
#include "renderer/passes/map_coordinates.h"

#include "renderer/passes/camera_pass.h"

namespace si {

void MapCoordinatesPass::declare(FrameState& f) {
    f.plan.place_result(Result::MapCoordinates, {&coordinates_});
    Pass pass;
    pass.name = "map coordinates";
    pass.category = PassCategory::Tool;
    pass.writes = {Result::MapCoordinates};
    pass.idle_reason = "not needed: no output shows which texels are read";
    if (!f.shown_view()) {
        pass.unneeded = "view.light has no shadow map";
        f.plan.add_pass(std::move(pass));
        return;
    }
    pass.key = f.shown_light_key().value();
    pass.cached = &coordinates_.key;
    pass.run = [this, &f](PassInfo& info) { run(f, info); };
    f.plan.add_pass(std::move(pass));
}

void MapCoordinatesPass::run(FrameState& f, PassInfo& info) {
    CameraPass(f, "map coordinates", GL_RGBA32F, coordinates_)
        .clear(glm::vec4(0))
        .draw("passes/map_coordinates.frag.glsl", {{"LIGHT_INDEX", std::to_string(f.settings.view.light)}}, info);
}

}  // namespace si
