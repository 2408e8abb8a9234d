// Nearest and farthest depth within the kernel's reach of each block of the shadow maps: where both lie on one side of
// a receiver, a look-up needs no taps. Exact, unlike taps that stand for others.
#include "renderer/passes/map_bounds.h"

#include <fmt/format.h>

#include "renderer/optimisations/lookup_optimisations.h"

namespace si {
namespace {

void draw_step(const FrameState& f, const gl::Target& into, int into_layer, int step, int layer, int reach,
               PassInfo& info) {
    const gl::Framebuffer framebuffer = gl::make_framebuffer("bounds of a shadow map", &into, nullptr, into_layer);
    f.begin_fullscreen_pass(framebuffer.id(), into.width, into.height);
    const GLuint id = f.program("passes/fullscreen.vert.glsl", "passes/map_bounds.frag.glsl",
                                {{"BOUNDS_STEP", std::to_string(step)}});
    glUseProgram(id);
    glUniform1i(glGetUniformLocation(id, "layer"), layer);
    glUniform1i(glGetUniformLocation(id, "reach"), reach);
    FrameState::draw_fullscreen(info);
}

void find_bounds(const FrameState& f, MapBoundsPass::Targets& t, PassInfo& info) {
    const int cells = (f.map_resolution + kBoundsCell - 1) / kBoundsCell;
    const int blocks = (cells + kBoundsCell - 1) / kBoundsCell;
    t.bounds.ensure("bounds of shadow maps", GL_RGBA32F, blocks, blocks, f.map_layers());
    t.cells.ensure("bounds of cells", GL_RGBA32F, cells, cells);
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& light = f.gl.fitted[i];
        if (!light.casts) continue;
        const int reach = bounds_reach_cells(f, light);
        for (int layer = f.first_view[i]; layer < f.first_view[i] + int(light.views.size()); ++layer) {
            if (f.layers_held[std::size_t(layer)].empty()) continue;
            draw_step(f, t.cells, -1, 0, layer, reach, info);
            glBindTextureUnit(shared::UNIT_BLURRED_ROWS, t.cells.texture.id());
            draw_step(f, t.bounds, t.bounds.layers == 0 ? -1 : layer, 1, layer, reach, info);
        }
    }
}

}  // namespace

void MapBoundsPass::declare(FrameState& f) {
    Pass pass;
    pass.name = "map bounds";
    pass.category = PassCategory::Maps;
    pass.reads = {Result::ShadowMaps};
    pass.writes = {Result::MapBounds};
    pass.idle_reason = "nothing samples a shadow map";
    pass.aid = true;
    pass.unneeded = why_no_bounds(f);
    choose_taps(f, pass.unneeded.empty());
    if (!pass.unneeded.empty()) {
        f.plan.release([this] { targets_ = {}; });
        f.plan.add(std::move(pass));
        return;
    }
    f.plan.place(Result::MapBounds, {&targets_.bounds, shared::UNIT_MAP_BOUNDS});
    Key key;
    key.add(f.settings.map.wrap).add(f.gl.programs.source().generation()).add(f.maps_extent);
    for (const FittedLight& light : f.gl.fitted) key.add(light.casts ? bounds_reach_cells(f, light) : 0);
    pass.key = key.value();
    pass.cached = &targets_.bounds.key;
    pass.run = [this, &f](PassInfo& info) { run(f, info); };
    f.plan.add(std::move(pass));
}

void MapBoundsPass::run(const FrameState& f, PassInfo& info) {
    find_bounds(f, targets_, info);
    info.reason += fmt::format("; depths within the kernel's reach of blocks of {0} x {0} texels", kBoundsBlock);
}

}  // namespace si
