// Passes that draw the map viewer's picture of a shadow map or of the camera's depth.
#include "renderer/passes/map_view.h"

#include <algorithm>
#include <limits>

#include "renderer/base/index_of.h"
#include "renderer/frame/depth_histogram.h"
#include "renderer/settings/filters.h"

namespace si {
namespace {

constexpr int kLargestPicture = 4096;
constexpr int kBlocks = 64;  ///< blocks per axis; the GPU finds the depth range of each

/// Binds a program that includes shaders/lib/shown_depth.glsl, and sets its uniforms.
GLuint use_program(const FrameState& f, std::string_view fragment, int layer) {
    const bool camera = f.settings.view.map_source == MapSource::Camera;
    std::vector<gl::Define> extra;
    const int channel = shown_channel(f.settings);
    if (camera) extra.push_back({"FROM_CAMERA", "1"});
    if (channel > 0) extra.push_back({"FROM_CHANNEL", "1"});
    const GLuint id = f.use_fullscreen(fragment, std::move(extra));
    if (!camera) glUniform1i(glGetUniformLocation(id, "layer"), layer);
    const DepthCurve& curve = *f.shown_curve();
    glUniform4f(glGetUniformLocation(id, "curve"), float(curve.near), float(curve.far), curve.perspective ? 1.f : 0.f,
                curve.convention.reversed && channel == 0 ? 1.f : 0.f);
    const DepthWarp warp = curve.warp.value_or(DepthWarp());
    glUniform4f(glGetUniformLocation(id, "warp"), float(warp.middle_m), float(warp.near_m), float(warp.far_m),
                float(warp.rise));
    return id;
}

/// Returns the pass that draws the shown moment as one number for each texel.
Pass channel_pass(FrameState& f, MapViewPasses::Targets& t, Key key, int layer) {
    f.plan.place_result(Result::MapChannel, {&t.channel, shared::UNIT_MAP_CHANNEL, nullptr});
    Pass pass{.name = "map channel",
              .category = PassCategory::Tool,
              .reads = {Result::Moments},
              .writes = {Result::MapChannel},
              .idle_reason = "the map viewer is closed"};
    if (shown_channel(f.settings) == 0) {
        if (f.request.outputs.shadow_map) pass.unneeded = "view.map_channel shows depth, no moment";
        f.plan.release_later([&t] { t.channel = {}; });
    }
    pass.key = key.add(f.settings.view.map).add(f.settings.filter.kernel).value();
    pass.cached = &t.channel.key;
    pass.run = [&f, &t, layer](PassInfo& info) {
        const int mip = f.shown_mip();
        const glm::ivec2 n = glm::max(f.map_size.sides() >> mip, glm::ivec2(1));
        t.channel.ensure("map channel", GL_R32F, n.x, n.y);
        const gl::Framebuffer framebuffer = f.begin_fullscreen_pass("map channel", t.channel);
        const GLuint id = f.use_fullscreen("passes/map_channel.frag.glsl");
        glUniform1i(glGetUniformLocation(id, "layer"), layer);
        glUniform1i(glGetUniformLocation(id, "mip"), mip);
        glUniform1i(glGetUniformLocation(id, "channel"), shown_channel(f.settings) - 1);
        glUniform1i(glGetUniformLocation(id, "as_share"), f.settings.view.map != MapView::Raw);
        FrameState::draw_fullscreen(info);
    };
    return pass;
}

Pass range_pass(FrameState& f, MapViewPasses::Targets& t, const Key& shown, int layer) {
    f.plan.place_result(Result::DepthRange, {&t.range});
    Pass pass{.name = "drawn depth range", .category = PassCategory::Tool, .writes = {Result::DepthRange}};
    if (f.request.outputs.shadow_map && !f.fits_grey_range())
        pass.unneeded = "view.map_fit is off, and the contrast does not fit itself (view.map_contrast)";
    pass.key = shown.value();
    pass.cached = &t.range.key;
    pass.run = [&f, &t, layer](PassInfo& info) {
        t.range.ensure("drawn depth range", GL_RG32F, kBlocks, kBlocks);
        const gl::Framebuffer framebuffer = f.begin_fullscreen_pass("drawn depth range", t.range);
        const GLuint id = use_program(f, "passes/depth_range.frag.glsl", layer);
        glUniform2i(glGetUniformLocation(id, "blocks"), kBlocks, kBlocks);
        FrameState::draw_fullscreen(info);
        const auto blocks = gl::read_texture<glm::vec2>(t.range.texture.id(), kBlocks * kBlocks, GL_RG, GL_FLOAT);
        t.drawn = blocks[0];
        for (const glm::vec2& b : blocks) t.drawn = {std::min(t.drawn.x, b.x), std::max(t.drawn.y, b.y)};
    };
    return pass;
}

}  // namespace

glm::vec2 MapViewPasses::grey_range(const FrameState& f) const {
    const glm::vec2 drawn = targets_.drawn;
    const ViewSettings& s = f.settings.view;
    if (!f.fits_grey_range() || drawn.x > drawn.y) return {s.map_black, s.map_white};
    // The range of a warped map covers at least the drawn depths, as the row of each depth is not read back.
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (const double row : {0.0, 1.0})
        for (const float stored : {drawn.x, drawn.y}) {
            const double value = shown_depth(stored, *f.shown_curve(), s.map, row);
            lo = std::min(lo, value);
            hi = std::max(hi, value);
        }
    if (shown_channel(f.settings) > 0) {
        lo = drawn.x;
        hi = drawn.y;
    }
    const double least = 1e-6;  // a single depth is shown in middle grey
    if (hi - lo < least) {
        lo = 0.5 * (lo + hi - least);
        hi = lo + least;
    }
    return {lo, hi};
}

void MapViewPasses::declare(FrameState& f) {
    Targets& t = targets_;
    f.plan.place_result(Result::MapView, {&t.picture});
    const ViewSettings& v = f.settings.view;
    const bool camera = v.map_source == MapSource::Camera;
    int layer = 0;
    const LightView* view = f.shown_view(&layer);
    const bool channel = shown_channel(f.settings) > 0;
    Pass pass{.name = "map viewer",
              .category = PassCategory::Tool,
              .reads = {camera    ? Result::CameraDepth
                        : channel ? Result::MapChannel
                                  : Result::ShadowMaps},
              .writes = {Result::MapView},
              .idle_reason = "the map viewer is closed"};
    if (!camera && !view) {
        const bool exists = std::size_t(v.light) < f.gl.fitted.size();
        return f.plan.skip_pass(std::move(pass),
                                exists ? f.gl.fitted[std::size_t(v.light)].reason : "there is no such light");
    }
    Key shown;
    shown.add(camera ? -1 : layer).add(f.gl.programs.source().generation());
    if (!camera) f.plan.add_pass(channel_pass(f, t, f.with_settings(shown, ReadBy::MapRange), layer));
    Pass range = range_pass(f, t, f.with_settings(shown, ReadBy::MapRange), layer);
    range.reads = pass.reads;
    range.idle_reason = pass.idle_reason;
    if (f.fits_grey_range()) pass.reads.push_back(Result::DepthRange);
    f.plan.add_pass(std::move(range));
    pass.key = f.with_settings(shown, ReadBy::MapView).add(f.request.with_look).value();
    pass.cached = &t.picture.key;
    pass.run = [this, &f, camera, layer](PassInfo& info) { run(f, camera, layer, info); };
    f.plan.add_pass(std::move(pass));
}

void MapViewPasses::run(FrameState& f, bool camera, int layer, PassInfo& info) {
    glm::ivec2 size = camera ? glm::ivec2(f.request.width, f.request.height) : f.map_size.sides();
    if (const int most = std::max(size.x, size.y); most > kLargestPicture)
        size = glm::max(size * kLargestPicture / most, glm::ivec2(1));
    targets_.picture.ensure("map viewer", GL_RGBA8, size.x, size.y);
    const gl::Framebuffer framebuffer = f.begin_fullscreen_pass("map viewer", targets_.picture);
    const GLuint id = use_program(f, "passes/map_view.frag.glsl", layer);
    const ViewSettings& s = f.settings.view;
    const glm::vec2 greys = grey_range(f);
    glUniform1i(glGetUniformLocation(id, "bare"), f.request.with_look);
    glUniform1i(glGetUniformLocation(id, "mode"), index_of(s.map));
    glUniform1i(glGetUniformLocation(id, "colours"), index_of(s.map_colours));
    glUniform4f(glGetUniformLocation(id, "range"), greys.x, greys.y, float(s.band_low), float(s.band_high));
    FrameState::draw_fullscreen(info);
}

}  // namespace si
