// Mean and mean square of the maps' depths about each texel, for the kernels that read those in place of depths.
#include <fmt/format.h>

#include "renderer/frame/state.h"
#include "renderer/settings/filters.h"

namespace si {
namespace {

struct MomentTargets {
    gl::Target moments, rows;  ///< RG32F: a layer a view, and one layer along x only
    gl::Sampler sampler;
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
    glBindTextureUnit(kShaded, t.rows.texture.id());
    draw(whole.id(), "1");
}

/// Beyond the map's sides as the maps' own sampler has it, a bilinear blend within.
void set_moments_sampler(const FrameState& f, gl::Sampler& sampler) {
    if (!sampler) sampler = gl::Sampler::create("moments");
    const MapSettings& m = f.settings.map;
    set_map_wrap(sampler.id(), m, m.outside == int(Outside::Lit) ? 1.f : 0.f);
    glSamplerParameteri(sampler.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glSamplerParameteri(sampler.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

}  // namespace

bool samples_moments(const FrameState& f) {
    return f.view_count > 0 && filter_of(f.settings).samples == Samples::Moments;
}

std::vector<ResultRef> lookup_reads(const FrameState& f) {
    if (samples_moments(f)) return {Result::ShadowMaps, Result::Moments};
    return {Result::ShadowMaps};
}

void bind_moments(const FrameState& f) {
    if (!samples_moments(f)) return;
    MomentTargets& t = f.gl.owned.get<MomentTargets>();
    if (!t.moments.texture) return;
    set_moments_sampler(f, t.sampler);
    glBindTextureUnit(kMoments, t.moments.texture.id());
    glBindSampler(kMoments, t.sampler.id());
}

void add_moments_pass(FrameState& f, std::vector<Pass>& plan) {
    Pass pass;
    pass.name = "moments";
    pass.reads = {Result::ShadowMaps};
    pass.writes = {Result::Moments};
    pass.category = PassCategory::Maps;
    pass.idle_reason = "nothing samples a shadow map";
    if (!samples_moments(f)) {
        pass.unneeded =
            f.view_count == 0 ? "no light has a shadow map" : "filter.kernel reads depths, not their mean and variance";
        f.gl.owned.drop<MomentTargets>();
        plan.push_back(std::move(pass));
        return;
    }
    MomentTargets& t = f.gl.owned.get<MomentTargets>();
    const int radius = f.settings.filter.blur;
    Key key = f.maps_key;
    pass.key = key.add(radius).value();
    if (t.moments.ensure("moments", GL_RG32F, f.map_resolution, f.map_resolution, f.gl.map.layers)) t.moments.key = 0;
    pass.cached = &t.moments.key;
    pass.run = [&f, &t, radius](PassInfo& info) {
        t.rows.ensure("moments along x", GL_RG32F, f.map_resolution, f.map_resolution);
        const auto rows = gl::make_framebuffer("moments along x", &t.rows, nullptr);
        f.bind_maps();
        for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
            const FittedLight& light = f.gl.fitted[i];
            for (std::size_t v = 0; light.casts && v < light.views.size(); ++v)
                sum_moments(f, t, rows, light.views[v], f.first_view[i] + int(v), info);
        }
        info.reason += fmt::format("; mean and mean square of {0} x {0} texels' depths", 2 * radius + 1);
    };
    plan.push_back(std::move(pass));
}

}  // namespace si
