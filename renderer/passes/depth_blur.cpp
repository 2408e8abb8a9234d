// Pass that blurs the stored depths themselves, which is wrong on purpose. The comparison then tests against a surface
// between occluder and receiver that does not exist ("corresponds to filtered geometry"). A filter averages test
// results instead.
#include "renderer/passes/depth_blur.h"

#include <fmt/format.h>

#include "renderer/optimisations/map_extents.h"
#include "renderer/settings/map_storage.h"

namespace si {
namespace {

/// Blurs one layer: rows of the map into `rows`, then columns of `rows` into the blurred map.
void blur_layer(FrameState& f, const DepthBlurPass::Targets& t, const gl::Framebuffer& rows, int layer,
                PassInfo& info) {
    const MapSize n = f.map_size;
    const bool colour = is_colour(f.settings.map.format);
    const auto draw = [&](GLuint framebuffer, const char* columns) {
        f.begin_fullscreen_pass(framebuffer, n.width, n.height);
        if (columns[0] == '1' && !colour) {
            glEnable(GL_DEPTH_TEST);  // without the test nothing is written
            glDepthFunc(GL_ALWAYS);
            glDepthMask(GL_TRUE);
        }
        const GLuint id = f.use_fullscreen("passes/depth_blur.frag.glsl", {{"BLUR_COLUMNS", columns}});
        glUniform1i(glGetUniformLocation(id, "layer"), layer);
        glUniform1i(glGetUniformLocation(id, "radius"), f.settings.map.blur_texels);
        FrameState::draw_fullscreen(f.drawn_cells_by_layer[std::size_t(layer)].texel_rects(n), info);
    };
    draw(rows.id(), "0");
    const int target_layer = t.maps.layers == 0 ? -1 : layer;
    const auto blurred = colour ? gl::make_framebuffer("blurred shadow map", &t.maps, nullptr, target_layer)
                                : gl::make_framebuffer("blurred shadow map", nullptr, &t.maps, -1, target_layer);
    glBindTextureUnit(shared::UNIT_BLURRED_ROWS, t.rows.texture.id());
    draw(blurred.id(), "1");
}

}  // namespace

void DepthBlurPass::declare(FrameState& f) {
    Pass pass{.name = "depth blur",
              .category = PassCategory::Maps,
              .reads = {Result::DrawnMaps},
              .writes = {Result::ShadowMaps},
              .idle_reason = "no pass samples a shadow map"};
    const int radius = f.settings.map.blur_texels;
    if (!f.blurs_depths()) {
        f.plan.release_later([this] { targets_ = {}; });
        return f.plan.skip_pass(std::move(pass), radius == 0 ? "map.blur_texels is 0" : "no light has a shadow map");
    }
    f.place_compared_maps(targets_.maps);
    pass.key = f.with_settings({}, ReadBy::DepthBlur).add(f.maps_extent).value();
    pass.cached = &targets_.maps.key;
    pass.run = [this, &f, radius](PassInfo& info) { run(f, radius, info); };
    f.plan.add_pass(std::move(pass));
}

void DepthBlurPass::run(FrameState& f, int radius, PassInfo& info) {
    Targets& t = targets_;
    const MapSize n = f.map_size;
    t.maps.ensure("blurred shadow maps", f.map_format(), n.width, n.height, f.map_layers());
    t.rows.ensure("shadow map blurred along x", GL_R32F, n.width, n.height);
    const auto rows = gl::make_framebuffer("shadow map blurred along x", &t.rows, nullptr);
    for (int layer = 0; layer < f.view_count; ++layer)
        if (!f.drawn_cells_by_layer[std::size_t(layer)].empty()) blur_layer(f, t, rows, layer, info);
    add_unread_texels_part(f, "blurred depths that no pass reads", info);
    info.reason +=
        fmt::format("; mean of {0} x {0} texels' depths, which gives wrong shadows on purpose", 2 * radius + 1);
}

}  // namespace si
