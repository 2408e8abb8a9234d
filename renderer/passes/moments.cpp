// Pass that averages functions of the maps' depths around each texel, for kernels that read moments in place of depths.
#include "renderer/passes/moments.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "renderer/base/index_of.h"
#include "renderer/optimisations/map_extents.h"
#include "renderer/passes/casters.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/map_storage.h"
#include "renderer/software/llvmpipe_queue.h"

namespace si {
namespace {

/// Input of a moment draw, as named in passes/moments.frag.glsl.
enum class From { Depths, Samples, Moments };

/// Returns the format of intermediate layers, with at least the bits of the stored moments.
GLenum step_format(const FrameState& f) {
    const StoredMoments& m = filter_of(f.settings).moments;
    if (m.summed) return f.settings.filter.sums == TableSums::Integer ? GL_RG32UI : GL_RG32F;
    return m.names.size() == 1 ? GL_R32F : m.names.size() == 2 ? GL_RG32F : GL_RGBA32F;
}

GLenum stored_format(const FrameState& f) {
    const StoredMoments& m = filter_of(f.settings).moments;
    if (m.summed || f.settings.filter.moment_format == MomentFormat::Bits32) return step_format(f);
    return m.names.size() == 1 ? GL_R16F : m.names.size() == 2 ? GL_RG16F : m.quantised ? GL_RGBA16 : GL_RGBA16F;
}

/// Computes the moments of one view's layer, step by step.
class LayerMaker {
public:
    LayerMaker(FrameState& f, MomentsPass::Targets& t, PassInfo& info) : f_(f), t_(t), info_(info) {}

    /// Computes the moments of one view.
    /// @param held drawn cells of the view's map
    /// @param emptied the map is drawn without casters (FrameRequest::emptied)
    void make(const FittedLight& light, const LightView& view, int layer, const MapCells& held, bool emptied) {
        const FilterSettings& s = f_.settings.filter;
        view_ = &view;
        layer_ = layer;
        texels_ = held.texel_rects(f_.map_size);
        From from = From::Depths;
        if (sampled(f_)) {
            draw_samples(light, view, held, emptied);
            from = From::Samples;
        }
        if (filter_of(f_.settings).moments.summed) {
            average(from, 0, 0, false);
            sum(0);
            sum(1);
            return;
        }
        if (s.blur == 0) return average(from, 0, 0, true);
        if (from == From::Samples) {
            average(from, 0, 0, false);
            from = From::Moments;
        }
        average(from, s.blur, 0, false);
        average(From::Moments, s.blur, 1, true);
    }

    static bool sampled(const FrameState& f) { return f.settings.map.samples > 1 && !f.blurs_depths(); }

private:
    FrameState& f_;
    MomentsPass::Targets& t_;
    PassInfo& info_;
    const LightView* view_ = nullptr;
    std::vector<TexelRect> texels_;  ///< drawn texels of the map
    int layer_ = 0, filled_ = 0;     ///< index in `steps` of the last draw's output

    /// Returns the framebuffer of the next draw: the layer itself, or the step that the draw does not read.
    gl::Framebuffer begin(bool last) {
        gl::Target& step = t_.steps[1 - filled_];
        if (!last) step.ensure("moments, a step", step_format(f_), f_.map_size.width, f_.map_size.height);
        glBindTextureUnit(shared::UNIT_BLURRED_ROWS, t_.steps[filled_].texture.id());
        filled_ = 1 - filled_;
        gl::Framebuffer into = gl::make_framebuffer("moments", last ? &t_.moments : &step, nullptr,
                                                    last && t_.moments.layers > 0 ? layer_ : -1);
        if (f_.driver.software) gl::limit_pending_draws();
        f_.begin_fullscreen_pass(into.id(), f_.map_size.width, f_.map_size.height);
        return into;
    }

    /// Averages along one axis.
    /// @param axis 0 along x, 1 along y
    void average(From from, int radius, int axis, bool last) {
        const gl::Framebuffer into = begin(last);
        // Windows are clipped near the map's sides only. Clipping every texel's window would cost a fifteenth of a
        // frame.
        const int n = axis == 0 ? f_.map_size.width : f_.map_size.height, cut = std::min(radius, (n + 1) / 2);
        const glm::ivec2 inner[] = {{cut, n - cut}}, sides[] = {{0, cut}, {std::max(cut, n - cut), n}};
        average_strips(from, radius, axis, last, true, inner);
        average_strips(from, radius, axis, last, false, sides);
    }

    /// Averages the drawn texels in strips [first, second) along the axis.
    /// @param whole no window is clipped
    void average_strips(From from, int radius, int axis, bool last, bool whole, std::span<const glm::ivec2> strips) {
        std::vector<TexelRect> rects;
        for (const glm::ivec2& strip : strips)
            for (TexelRect r : texels_) {
                r.from[axis] = std::max(r.from[axis], strip[0]);
                r.to[axis] = std::min(r.to[axis], strip[1]);
                if (r.from[axis] < r.to[axis]) rects.push_back(r);
            }
        if (rects.empty()) return;
        const bool summed = filter_of(f_.settings).moments.summed;
        const GLuint id = f_.use_fullscreen("passes/moments.frag.glsl",
                                            {{"BLUR_COLUMNS", std::to_string(axis)},
                                             {"MOMENTS_FROM_SAMPLES", std::to_string(index_of(From::Samples))},
                                             {"MOMENTS_FROM_MOMENTS", std::to_string(index_of(From::Moments))},
                                             {"MOMENTS_FROM", std::to_string(int(from))},
                                             {"MOMENTS_AS_SUMS", summed ? "1" : "0"},
                                             {"BLUR_RADIUS", std::to_string(radius)},
                                             {"BLUR_WINDOW_IS_WHOLE", whole ? "1" : "0"},
                                             {"MOMENTS_LAST", last ? "1" : "0"}});
        if (from == From::Samples) glBindTextureUnit(shared::UNIT_MAP_SAMPLES, t_.samples.texture.id());
        const DepthCurve& curve = view_->curve;
        glUniform1i(glGetUniformLocation(id, "layer"), layer_);
        glUniform4f(glGetUniformLocation(id, "curve"), float(curve.near), float(curve.far),
                    curve.perspective ? 1.f : 0.f, 0.f);
        f_.draw_fullscreen(rects, info_);
    }

    /// Sums the last draw's output along an axis; the last axis writes into the layer.
    void sum(int axis) {
        const GLuint id = f_.use_fullscreen("passes/sums.frag.glsl", {{"BLUR_COLUMNS", std::to_string(axis)}});
        const int n = axis == 0 ? f_.map_size.width : f_.map_size.height;
        for (int run = 1; run == 1 || run < n; run *= 8) {
            const gl::Framebuffer into = begin(axis == 1 && run * 8 >= n);
            glUseProgram(id);
            glUniform1i(glGetUniformLocation(id, "run"), run);
            FrameState::draw_fullscreen(info_);
        }
    }

    void draw_samples(const FittedLight& light, const LightView& view, const MapCells& held, bool emptied) {
        const bool colour = is_colour(f_.settings.map.format);
        t_.samples.ensure("samples of a map", colour ? GLenum(GL_DEPTH_COMPONENT32F) : f_.map_format(),
                          f_.map_size.width, f_.map_size.height, 0, {.samples = f_.settings.map.samples});
        const gl::Framebuffer into = gl::make_framebuffer("samples of a map", nullptr, &t_.samples);
        if (emptied)
            clear_casters(f_, into.id(), view.curve.convention);
        else
            draw_casters(f_, into, false, light, view, info_, {.needed = &held});
    }
};

bool samples_moments(const FrameState& f) {
    return f.view_count > 0 && filter_of(f.settings).samples() == Samples::Moments;
}

/// Returns a description of the moments for the pass's reason.
std::string description(const FrameState& f) {
    const Filter& row = filter_of(f.settings);
    std::string names;
    for (const std::string_view name : row.moments.names) names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    const int width = 2 * f.settings.filter.blur + 1;
    std::string out = row.moments.summed ? fmt::format("; sums of {}", names)
                                         : fmt::format("; means of {} over {} x {} texels", names, width, width);
    if (LayerMaker::sampled(f)) out += fmt::format(", {} samples each", f.settings.map.samples);
    if (keeps_mips(f.settings)) out += ", with mip levels";
    const PrefilterBytes bytes = prefilter_bytes(f.settings);
    return out + fmt::format("; {:.3g} bytes a texel", bytes.kept);
}

}  // namespace

std::vector<ResultRef> kernel_inputs(const FrameState& f) {
    if (samples_moments(f)) return {Result::ShadowMaps, Result::Moments};
    return {Result::ShadowMaps, Result::MapBounds};
}

void MomentsPass::declare(FrameState& f) {
    Pass pass{.name = "moments",
              .category = PassCategory::Maps,
              .reads = {Result::ShadowMaps},
              .writes = {Result::Moments},
              .idle_reason = "no pass samples a shadow map"};
    if (!samples_moments(f)) {
        f.plan.release_later([this] { targets_ = {}; });
        return f.plan.skip_pass(std::move(pass), f.view_count == 0 ? "no light has a shadow map"
                                                                   : "filter.kernel reads depths, no moments");
    }
    const bool summed = filter_of(f.settings).moments.summed;
    // Summed-area tables are fetched without filtering.
    f.plan.place_result(Result::Moments,
                        {&targets_.moments, shared::UNIT_MOMENTS, summed ? nullptr : &f.gl.map_blended});
    pass.key = f.with_settings(Key().add(filter_of(f.settings).key), ReadBy::Moments).add(f.maps_extent).value();
    pass.cached = &targets_.moments.key;
    pass.run = [this, &f](PassInfo& info) { run(f, info); };
    f.plan.add_pass(std::move(pass));
}

void MomentsPass::run(FrameState& f, PassInfo& info) {
    Targets& t = targets_;
    const MapSize n = f.map_size;
    const bool mips = keeps_mips(f.settings);
    const int levels = mips ? gl::mip_levels(n.longest()) : 1;
    t.moments.ensure("moments", stored_format(f), n.width, n.height, f.map_layers(), {.levels = levels});
    if (!LayerMaker::sampled(f)) t.samples = {};
    LayerMaker maker(f, t, info);
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i) {
        const FittedLight& light = f.gl.fitted[i];
        for (std::size_t v = 0; light.casts && v < light.views.size(); ++v)
            if (const auto layer = std::size_t(f.first_view[i]) + v; !f.drawn_cells_by_layer[layer].empty())
                maker.make(light, light.views[v], int(layer), f.drawn_cells_by_layer[layer],
                           f.request.emptied == MapOfLight{int(i), int(v)});
    }
    if (mips) glGenerateTextureMipmap(t.moments.texture.id());
    add_unread_texels_part(f, "moments that no pass reads", info);
    info.reason += description(f);
}

}  // namespace si
