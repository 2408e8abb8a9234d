// Blurs the stored depths themselves: wrong on purpose. The comparison then tests against a surface between occluder
// and receiver that is not there ("corresponds to filtered geometry"), where a filter averages the tests' results.
#include <fmt/format.h>

#include "renderer/frame/state.h"

namespace si {
namespace {

/// Both axes of one layer: rows of the map into `rows`, columns of that into the blurred map.
void blur_layer(FrameState& f, const gl::Framebuffer& rows, int layer, PassInfo& info) {
    const int n = f.map_resolution;
    const auto draw = [&](GLuint framebuffer, const char* columns) {
        f.begin_fullscreen_pass(framebuffer, n, n);
        if (columns[0] == '1' && f.gl.map.format != GL_R32F) {
            glEnable(GL_DEPTH_TEST);  // without the test nothing is written
            glDepthFunc(GL_ALWAYS);
            glDepthMask(GL_TRUE);
        }
        const GLuint id =
            f.program("passes/fullscreen.vert.glsl", "passes/depth_blur.frag.glsl", {{"BLUR_COLUMNS", columns}});
        glUseProgram(id);
        glUniform1i(glGetUniformLocation(id, "layer"), layer);
        glUniform1i(glGetUniformLocation(id, "radius"), f.settings.map.blur_texels);
        FrameState::draw_fullscreen(info);
    };
    glBindTextureUnit(kShadowMap, f.gl.map.texture.id());
    draw(rows.id(), "0");
    const int target_layer = f.gl.map.layers == 0 ? -1 : layer;
    const bool colour = f.gl.map.format == GL_R32F;
    const auto blurred = colour
                             ? gl::make_framebuffer("blurred shadow map", &f.gl.map_blurred, nullptr, target_layer)
                             : gl::make_framebuffer("blurred shadow map", nullptr, &f.gl.map_blurred, -1, target_layer);
    glBindTextureUnit(kShaded, f.gl.map_rows.texture.id());
    draw(blurred.id(), "1");
}

}  // namespace

void add_depth_blur_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "depth blur";
    pass.category = PassCategory::Maps;
    pass.reads = pass.writes = {Result::ShadowMaps};
    pass.idle_reason = "nothing samples a shadow map";
    const int radius = f.settings.map.blur_texels;
    if (radius == 0 || f.view_count == 0) {
        pass.unneeded = radius == 0 ? "map.blur_texels is 0: depths stay as drawn" : "no light has a shadow map";
        f.gl.map_blurred = {}, f.gl.map_rows = {};
        plan.push_back(std::move(pass));
        return;
    }
    f.gl.map_blurred.ensure("blurred shadow maps", f.gl.map.format, f.map_resolution, f.map_resolution,
                            f.gl.map.layers);
    f.maps_key.add(radius);
    pass.key = f.maps_key.value();
    pass.cached = &f.gl.map_blurred.key;
    pass.run = [&f, radius](PassInfo& info) {
        f.gl.map_rows.ensure("shadow map blurred along x", GL_R32F, f.map_resolution, f.map_resolution);
        const auto rows = gl::make_framebuffer("shadow map blurred along x", &f.gl.map_rows, nullptr);
        for (int layer = 0; layer < f.view_count; ++layer) blur_layer(f, rows, layer, info);
        info.reason += fmt::format("; mean of {0} x {0} texels' depths, wrong on purpose", 2 * radius + 1);
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
