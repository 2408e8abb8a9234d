// Blurs the stored depths themselves: wrong on purpose. The comparison then tests against a surface between occluder
// and receiver that is not there ("corresponds to filtered geometry"), where a filter averages the tests' results.
#include "renderer/passes/depth_blur.h"

#include <fmt/format.h>

#include "renderer/optimisations/map_extents.h"
#include "renderer/passes/compared_maps.h"
#include "renderer/settings/map_storage.h"

namespace si {
namespace {

/// Both axes of one layer: rows of the map into `rows`, columns of that into the blurred map.
void blur_layer(FrameState& f, const DepthBlurPass::Targets& t, const gl::Framebuffer& rows, int layer,
                PassInfo& info) {
    const int n = f.map_resolution;
    const bool colour = is_colour(f.settings.map.format);
    const auto draw = [&](GLuint framebuffer, const char* columns) {
        f.begin_fullscreen_pass(framebuffer, n, n);
        if (columns[0] == '1' && !colour) {
            glEnable(GL_DEPTH_TEST);  // without the test nothing is written
            glDepthFunc(GL_ALWAYS);
            glDepthMask(GL_TRUE);
        }
        const GLuint id =
            f.program("passes/fullscreen.vert.glsl", "passes/depth_blur.frag.glsl", {{"BLUR_COLUMNS", columns}});
        glUseProgram(id);
        glUniform1i(glGetUniformLocation(id, "layer"), layer);
        glUniform1i(glGetUniformLocation(id, "radius"), f.settings.map.blur_texels);
        FrameState::draw_fullscreen(f.layers_held[std::size_t(layer)].texels(n), info);
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
    Pass pass;
    pass.name = "depth blur";
    pass.category = PassCategory::Maps;
    pass.reads = {Result::DrawnMaps};
    pass.writes = {Result::ShadowMaps};
    pass.idle_reason = "nothing samples a shadow map";
    const int radius = f.settings.map.blur_texels;
    if (!f.blurs_depths()) {
        pass.unneeded = radius == 0 ? "map.blur_texels is 0: depths stay as drawn" : "no light has a shadow map";
        f.plan.release([this] { targets_ = {}; });
        f.plan.add(std::move(pass));
        return;
    }
    place_compared_maps(f, targets_.maps);
    pass.key = f.with_settings({}, ReadBy::DepthBlur).add(f.maps_extent).value();
    pass.cached = &targets_.maps.key;
    pass.run = [this, &f, radius](PassInfo& info) { run(f, radius, info); };
    f.plan.add(std::move(pass));
}

void DepthBlurPass::run(FrameState& f, int radius, PassInfo& info) {
    Targets& t = targets_;
    const int n = f.map_resolution;
    t.maps.ensure("blurred shadow maps", f.map_format(), n, n, f.map_layers());
    t.rows.ensure("shadow map blurred along x", GL_R32F, n, n);
    const auto rows = gl::make_framebuffer("shadow map blurred along x", &t.rows, nullptr);
    for (int layer = 0; layer < f.view_count; ++layer)
        if (!f.layers_held[std::size_t(layer)].empty()) blur_layer(f, t, rows, layer, info);
    if (std::optional<PartInfo> part = unread_texels(f, "blurred depths that nothing reads"))
        info.parts.push_back(std::move(*part));
    info.reason += fmt::format("; mean of {0} x {0} texels' depths, wrong on purpose", 2 * radius + 1);
}

}  // namespace si
