// The pass map bounds: two parallel planes around all depths within the kernel's reach, for each block of the shadow
// maps. A look-up of a receiver on one side of both planes needs no taps. The result is exact.
#include "renderer/passes/map_bounds.h"

#include <fmt/format.h>

#include "renderer/optimisations/lookup_optimisations.h"

namespace si {
namespace {

void draw_step(const FrameState& f, const gl::Target& into, int into_layer, int step, int layer, int reach,
               PassInfo& info) {
    const gl::Framebuffer framebuffer = f.begin_fullscreen_pass("bounds of a shadow map", into, into_layer);
    const GLuint id = f.use_fullscreen("passes/map_bounds.frag.glsl", {{"BOUNDS_STEP", std::to_string(step)}});
    glUniform1i(glGetUniformLocation(id, "layer"), layer);
    glUniform1i(glGetUniformLocation(id, "reach"), reach);
    FrameState::draw_fullscreen(info);
}

}  // namespace

void MapBoundsPass::run(const FrameState& f, PassInfo& info) {
    Targets& t = targets_;
    const glm::ivec2 cells = (f.map_size.sides() + kBoundsCell - 1) / kBoundsCell;
    const glm::ivec2 blocks = (cells + kBoundsCell - 1) / kBoundsCell;
    t.bounds.ensure("bounds of shadow maps", GL_RGBA32F, blocks.x, blocks.y, f.map_layers());
    t.cells.ensure("bounds of cells", GL_RGBA32F, cells.x, cells.y);
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& light = f.gl.fitted[i];
        if (!light.casts) continue;
        const int reach = kernel_reach_cells(f, light);
        for (int layer = f.first_view[i]; layer < f.first_view[i] + int(light.views.size()); ++layer) {
            if (f.drawn_cells_by_layer[std::size_t(layer)].empty()) continue;
            draw_step(f, t.cells, -1, 0, layer, reach, info);
            glBindTextureUnit(shared::UNIT_BLURRED_ROWS, t.cells.texture.id());
            draw_step(f, t.bounds, t.bounds.layers == 0 ? -1 : layer, 1, layer, reach, info);
        }
    }
    info.reason += fmt::format("; depths within the kernel's reach of blocks of {0} x {0} texels", kBoundsBlock);
}

void MapBoundsPass::declare(FrameState& f) {
    Pass pass{.name = "map bounds",
              .category = PassCategory::Maps,
              .reads = {Result::ShadowMaps},
              .writes = {Result::MapBounds},
              .unneeded = map_bounds_skip_reason(f),
              .only_saves_work = true,
              .idle_reason = "no pass samples a shadow map"};
    define_kernel_taps(f, pass.unneeded.empty());
    if (pass.unneeded.empty() || pass.unneeded == kMapBoundsWaitReason ||
        f.request.forced.contains(Optimisation::EarlyOut))
        pass.by = Optimisation::EarlyOut;
    if (!pass.unneeded.empty()) {
        f.plan.release_later([this] { targets_ = {}; });
        f.plan.add_pass(std::move(pass));
        return;
    }
    f.plan.place_result(Result::MapBounds, {&targets_.bounds, shared::UNIT_MAP_BOUNDS});
    Key key;
    key.add(f.settings.map.wrap).add(f.gl.programs.source().generation()).add(f.maps_extent);
    for (const FittedLight& light : f.gl.fitted) key.add(light.casts ? kernel_reach_cells(f, light) : 0);
    pass.key = key.value();
    pass.cached = &targets_.bounds.key;
    pass.run = [this, &f](PassInfo& info) { run(f, info); };
    f.plan.add_pass(std::move(pass));
}

}  // namespace si
