// Mean and mean square of the maps' depths about each texel, for the kernels that read those in place of depths.
#include <fmt/format.h>

#include "renderer/frame/state.h"
#include "renderer/settings/filters.h"

namespace si {
namespace {

struct MomentTargets {
    gl::Target moments, rows;  ///< RG32F: a layer a view, and one layer along x only
};

/// Stored depths along x into `rows`, then those along y into the layer.
void sum_moments(FrameState& f, MomentTargets& t, const gl::Framebuffer& rows, const LightView& view, int layer,
                 PassInfo& info) {
    const int n = f.map_resolution;
    const auto draw = [&](GLuint framebuffer, const char* columns) {
        f.begin_fullscreen_pass(framebuffer, n, n);
        const GLuint id =
            f.program("passes/fullscreen.vert.glsl", "passes/moments.frag.glsl", {{"BLUR_COLUMNS", columns}});
        glUseProgram(id);
        glUniform1i(glGetUniformLocation(id, "layer"), layer);
        glUniform1i(glGetUniformLocation(id, "radius"), f.settings.filter.blur);
        glUniform4f(glGetUniformLocation(id, "curve"), float(view.curve.near), float(view.curve.far),
                    view.curve.perspective ? 1.f : 0.f, 0.f);
        FrameState::draw_fullscreen(info);
    };
    draw(rows.id(), "0");
    const auto whole = gl::make_framebuffer("moments", &t.moments, nullptr, t.moments.layers == 0 ? -1 : layer);
    glBindTextureUnit(shared::UNIT_BLURRED_ROWS, t.rows.texture.id());
    draw(whole.id(), "1");
}

bool samples_moments(const FrameState& f) {
    return f.view_count > 0 && filter_of(f.settings).samples == Samples::Moments;
}

}  // namespace

std::vector<ResultRef> lookup_reads(const FrameState& f) {
    if (samples_moments(f)) return {Result::ShadowMaps, Result::Moments};
    return {Result::ShadowMaps};
}

void add_moments_pass(FrameState& f) {
    Pass pass;
    pass.name = "moments";
    pass.reads = {Result::ShadowMaps};
    pass.writes = {Result::Moments};
    pass.category = PassCategory::Maps;
    pass.idle_reason = "nothing samples a shadow map";
    if (!samples_moments(f)) {
        pass.unneeded =
            f.view_count == 0 ? "no light has a shadow map" : "filter.kernel reads depths, not their mean and variance";
        f.plan.release([&f] { f.gl.owned.drop<MomentTargets>(); });
        f.plan.add(std::move(pass));
        return;
    }
    MomentTargets& t = f.gl.owned.get<MomentTargets>();
    f.plan.place(Result::Moments, {&t.moments, shared::UNIT_MOMENTS, &f.gl.map_blended});
    const int radius = f.settings.filter.blur;
    pass.key = f.with_settings({}, ReadBy::Moments).value();
    pass.cached = &t.moments.key;
    pass.run = [&f, &t, radius](PassInfo& info) {
        const int n = f.map_resolution;
        t.moments.ensure("moments", GL_RG32F, n, n, f.map_layers());
        t.rows.ensure("moments along x", GL_RG32F, n, n);
        const auto rows = gl::make_framebuffer("moments along x", &t.rows, nullptr);
        for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
            const FittedLight& light = f.gl.fitted[i];
            for (std::size_t v = 0; light.casts && v < light.views.size(); ++v)
                sum_moments(f, t, rows, light.views[v], f.first_view[i] + int(v), info);
        }
        info.reason += fmt::format("; mean and mean square of {0} x {0} texels' depths", 2 * radius + 1);
    };
    f.plan.add(std::move(pass));
}

}  // namespace si
