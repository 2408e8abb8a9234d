// Probe of one pixel: reads its surface and kernel results from the GPU.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "renderer/base/error.h"
#include "renderer/frame/blocks.h"
#include "renderer/frame/causes.h"
#include "renderer/frame/requested_maps.h"
#include "renderer/inspect/comparison.h"
#include "renderer/inspect/moment_bound.h"
#include "renderer/passes/casters.h"
#include "renderer/reference/shadow_runs.h"
#include "renderer/render/renderer.h"
#include "renderer/render/renderer_impl.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

constexpr int kMaxTaps = 1024;

struct PixelFacts {
    std::array<glm::vec4, 4> values{};  // outputs of probe.frag.glsl
    bool hit() const { return values[0].w > 0.5f; }
    glm::uvec2 id() const {
        return {std::uint32_t(values[0].w + 0.5f), std::uint32_t(values[2].w) << 16 | std::uint32_t(values[1].w) >> 2};
    }
    bool receives() const { return (std::uint32_t(values[1].w) & 1) != 0; }
    bool in_map() const { return (std::uint32_t(values[1].w) & 2) != 0; }
};

/// Pixel of a probe, and the shift by which its block is drawn: see settle().
struct BlockPlace {
    int x = 0, y_bottom = 0;
    glm::vec2 shift{0};  ///< pixels
};

/// Block of 2x2 pixels around the probed one, so that derivatives equal those of the whole picture.
template <std::size_t Count>
class Block {
public:
    Block(FrameState& f, const BlockPlace& at) : f_(f), x_(at.x), y_(at.y_bottom) {
        for (gl::Target& t : targets_) t.ensure("probe", GL_RGBA32F, 2, 2);
        depth_.ensure("probe depth", GL_DEPTH_COMPONENT32F, 2, 2);
        framebuffer_ = gl::make_framebuffer("probe", targets_, depth_);
        f.begin_camera_pass(framebuffer_.id());
        f.bind_results(kernel_inputs(f));
        const float far_depth = float(f.camera.curve.convention.far_depth());
        glClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &far_depth);
        glViewportIndexedf(0, float(-(x_ & ~1)) + at.shift.x, float(-(y_ & ~1)) + at.shift.y, float(f.request.width),
                           float(f.request.height));
        const glm::vec4 nothing(0);
        for (GLint i = 0; i < GLint(Count); ++i) glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, i, &nothing.x);
    }
    const std::array<gl::Target, Count>& targets() const { return targets_; }
    glm::vec4 value(std::size_t i) const {
        std::array<glm::vec4, 4> block;
        gl::prepare_read_back();
        glGetTextureImage(targets_[i].texture.id(), 0, GL_RGBA, GL_FLOAT, sizeof block, block.data());
        return block[std::size_t((y_ & 1) * 2 + (x_ & 1))];
    }

private:
    FrameState& f_;
    int x_, y_;
    std::array<gl::Target, Count> targets_;
    gl::Target depth_;
    gl::Framebuffer framebuffer_;
};

PixelFacts draw_pixel(FrameState& f, const BlockPlace& at, int light) {
    const Block<4> block(f, at);
    PassInfo info;
    f.surface_flags = true;  // the object's index is read back
    // The frame's plan may have the pass map bounds, but the probe does not run the plan.
    f.draw_from_camera("passes/probe.frag.glsl", {{"LIGHT_INDEX", std::to_string(light)}, {"MAP_BOUNDS", "0"}}, info);
    PixelFacts facts;
    for (std::size_t i = 0; i < 4; ++i) facts.values[i] = block.value(i);
    return facts;
}

/// Surface of the probed pixel, independent of lights.
struct SeenPixel {
    Block<kVisibleSurfaceImages> block;
    glm::ivec2 at;  ///< in the block

    SeenPixel(FrameState& f, const BlockPlace& place) : block(f, place), at(place.x & 1, place.y_bottom & 1) {
        PassInfo info;
        f.draw_from_camera("passes/seen_surfaces.frag.glsl", {}, info);
    }
};

/// Runs the kernel of a pixel once for each of `width` fragments.
std::vector<glm::vec4> run_kernel(FrameState& f, const SeenPixel& seen, int light, int width,
                                  std::vector<gl::Define> defines) {
    PassInfo info;
    gl::Target taps;
    taps.ensure("taps", GL_RGBA32F, width, 1);
    const gl::Framebuffer framebuffer = gl::make_framebuffer("taps", &taps, nullptr);
    f.begin_fullscreen_pass(framebuffer.id(), width, 1);
    f.bind_results(kernel_inputs(f));
    bind_visible_surfaces(seen.block.targets());
    defines.push_back({"LIGHT_INDEX", std::to_string(light)});
    const GLuint program = f.program("passes/fullscreen.vert.glsl", "passes/taps.frag.glsl", std::move(defines));
    glUseProgram(program);
    glUniform2i(glGetUniformLocation(program, "pixel"), seen.at.x, seen.at.y);
    FrameState::draw_fullscreen(info);
    std::vector<glm::vec4> values(std::size_t(width), glm::vec4(0));
    gl::prepare_read_back();
    glGetTextureImage(taps.texture.id(), 0, GL_RGBA, GL_FLOAT, GLsizei(values.size() * sizeof(glm::vec4)),
                      values.data());
    return values;
}

/// Returns the weight of each texel that the kernel reads, found with one texel lit and all others dark. Exact for
/// every kernel that is linear in its comparisons.
std::vector<RecordedTap> draw_taps(FrameState& f, const SeenPixel& seen, int light) {
    std::vector<RecordedTap> out;
    if (!filter_of(f.settings).linear) return out;
    for (const glm::vec4& v : run_kernel(f, seen, light, kMaxTaps, {{"RECORD_TAPS", "1"}, {"COMPARE_BY_HAND", "1"}}))
        if (v.w >= 0) out.push_back({glm::ivec2(glm::clamp(glm::vec2(v), -1e9f, 1e9f)), v.z, v.w});
    return out;
}

/// Returns intermediate results of a moment kernel; empty for other kernels.
std::vector<std::string> moment_lines(const Filter& row, const FilterSettings& s, const KernelFacts& k) {
    const StoredMoments& stored = row.moments;
    if (std::isnan(k.bound)) return {};
    std::string moments;
    for (std::size_t i = 0; i < stored.names.size(); ++i)
        moments += fmt::format("{}{} {:.7g}", i ? "   " : "", stored.names[i], k.moments[i]);
    std::string depths = fmt::format("depths about {:.6f} of the range, compared {:.6f}", k.mean, k.own);
    if (!std::isnan(k.variance)) depths += fmt::format("   variance {:.4g}", k.variance);
    if (k.margin < 0) depths += fmt::format("   of no distribution, by {:.2g}", -k.margin);
    const MomentBound bound = moment_bound(row, s, k);
    std::vector<std::string> lines = {moments, depths, fmt::format("lit at most {:.6g} = {}", k.bound, bound.formula)};
    if (!bound.clamp.empty()) lines.push_back(bound.clamp);
    if (k.bound < 1 && stored.reduces_bleeding && s.bleed > 0)
        lines.push_back(fmt::format("({0:.6g} - {1:g}) / (1 - {1:g}){2} after light-bleed reduction (filter.bleed)",
                                    k.bound, s.bleed, k.bound < s.bleed ? ", clamped to 0," : ""));
    return lines;
}

KernelFacts draw_kernel_facts(FrameState& f, const SeenPixel& seen, int light) {
    const std::vector<glm::vec4> v = run_kernel(f, seen, light, 3, {});
    KernelFacts facts{.blocker_m = v[0].x,
                      .penumbra_texels = v[0].y,
                      .texels = v[0].z,
                      .variance = v[0].w,
                      .moments = {v[1].x, v[1].y, v[1].z, v[1].w},
                      .mean = v[2].x,
                      .own = v[2].y,
                      .margin = v[2].z,
                      .bound = v[2].w,
                      .lines = {}};
    facts.lines = moment_lines(filter_of(f.settings), f.settings.filter, facts);
    return facts;
}

CauseEvidence draw_trials(FrameState& f, const BlockPlace& at, int light) {
    const Block<kEvidenceImages> block(f, at);
    f.bind_results({Result::UnfilteredMap});
    PassInfo info;
    draw_evidence(f, light, false, info);
    std::array<glm::vec4, kEvidenceImages> values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = block.value(i);
    return std::bit_cast<CauseEvidence>(values);
}

/// Finds the pixel's surface as the picture shows it, and the shift with which its block shows the same. An edge-on
/// triangle may cover a pixel only by the rounding of its corners to 1/256 pixel, which differs in a block. Shifts
/// below that are tried then. Where none helps, the block shows the surface behind.
PixelFacts settle(FrameState& f, const glm::uvec2& shown, BlockPlace& at) {
    constexpr int kTries = 64;
    const PixelFacts unshifted = draw_pixel(f, at, 0);
    if (unshifted.id() == shown) return unshifted;
    for (int i = 1; i <= kTries; ++i) {
        BlockPlace tried = at;
        // Shifts are spread evenly (Roberts' R2 sequence).
        tried.shift = (glm::fract(glm::vec2(0.7548777f, 0.5698403f) * float(i)) - 0.5f) / 128.f;
        if (const PixelFacts facts = draw_pixel(f, tried, 0); facts.id() == shown) return at = tried, facts;
    }
    return unshifted;
}

/// Returns the corners of the triangle of a pixel; nullopt for none. @param id as in SurfaceIds
std::optional<std::array<glm::dvec3, 3>> corners_ws(const Scene& scene, const glm::uvec2& id) {
    const std::size_t number = std::size_t(id.x) - 1;
    if (number >= scene.objects.size()) return {};
    const Object& object = scene.objects[number];
    const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
    // Drivers may continue to count triangles over the instances of a draw.
    const std::size_t first = 3 * (id.y % (mesh.indices.size() / 3));
    std::array<glm::dvec3, 3> out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = glm::dvec3(object.world * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[first + k]]), 1));
    return out;
}

/// @param[out] at top left pixel
SurfaceIds part_of(const SurfaceIds& all, glm::ivec2 pixel, glm::ivec2& at) {
    at = glm::max(pixel - kRunReach, glm::ivec2(0));
    const glm::ivec2 end = glm::min(pixel + kRunReach + 1, glm::ivec2(all.width, all.height));
    SurfaceIds out{end.x - at.x, end.y - at.y, {}};
    for (int y = at.y; y < end.y; ++y) {
        const auto row = all.data.begin() + std::ptrdiff_t(y) * all.width;
        out.data.insert(out.data.end(), row + at.x, row + end.x);
    }
    return out;
}

}  // namespace

Probe Renderer::probe(const Scene& scene, const Settings& settings, const FrameRequest& request, int x, int y) {
    if (x < 0 || y < 0 || x >= request.width || y >= request.height)
        throw UsageError(
            fmt::format("pixel {},{} lies outside the picture of {} x {} pixels", x, y, request.width, request.height));
    FrameRequest maps = request;
    maps.outputs = {.colour = false, .shadow_map = true, .surface_ids = true, .unfiltered_map = true};
    for (int i = 0; i < std::clamp(settings.light_count, 0, kMaxLights); ++i)
        maps.outputs.visibility |= !source_of(settings, i).fused || settings.lights[std::size_t(i)].contact > 0;
    maps.force = maps.timing = false;
    const FrameResult frame = render(scene, settings, maps);
    const SurfaceIds ids = read_surface_ids(frame.surface_ids);
    FrameState f = impl_->prepare_frame(scene, settings, maps);
    f.pixel_origin = {x & ~1, (request.height - 1 - y) & ~1};  // the block of pixels that is drawn
    impl_->plan_frame(f);
    upload_blocks(f);
    Probe out;
    out.x = x;
    out.y = y;
    out.width = request.width;
    out.height = request.height;
    out.camera = f.camera;
    out.map_resolution = f.map_size.longest();
    out.map_size = f.map_size;
    out.around = part_of(ids, {x, y}, out.around_at);
    const int y_bottom = request.height - 1 - y;
    const glm::uvec2 shown = ids.data[std::size_t(y) * std::size_t(ids.width) + std::size_t(x)];
    if (shown.x == 0) return out;
    BlockPlace place{x, y_bottom};
    const PixelFacts first = settle(f, shown, place);
    std::optional<SeenPixel> seen;
    for (std::size_t i = 0; i < std::max<std::size_t>(f.gl.fitted.size(), 1); ++i) {
        const PixelFacts facts = i == 0 ? first : draw_pixel(f, place, int(i));
        out.hit = facts.hit();
        if (!out.hit) return out;
        out.position_ws = glm::dvec3(facts.values[0]) + f.origin;
        out.normal_ws = glm::dvec3(facts.values[1]);
        out.id = facts.id();
        const auto object = std::size_t(out.id.x - 1);
        if (object < scene.objects.size()) {
            out.object = scene.nodes[std::size_t(scene.objects[object].node)].path;
            out.may_cast = can_cast(scene, f.settings, scene.objects[object]);
        }
        if (i >= f.gl.fitted.size()) break;
        FloatImage map;
        if (const FittedLight& light = f.gl.fitted[i]; light.casts)
            map = read_shadow_map(frame, int(i), int(light.chooser.choose(light.views, out.position_ws).view));
        TestedPixel pixel{.light = int(i),
                          .point = {.position_ws = out.position_ws, .geometric = out.normal_ws},
                          .receives = facts.receives(),
                          .visibility = facts.values[3].x};
        // The probe's own pass draws neither contact shadows nor sources that shading cannot evaluate.
        if (f.has_contact_shadows(i) || (f.gl.fitted[i].shadowed && !source_of(f.settings, int(i)).fused)) {
            float drawn = 1;
            gl::prepare_read_back();
            glGetTextureSubImage(f.result(Result::Visibility).texture.id(), 0, x, y_bottom, GLint(i), 1, 1, 1, GL_RED,
                                 GL_FLOAT, sizeof drawn, &drawn);
            pixel.visibility = drawn;
        }
        const NormalSource source = f.settings.bias.normal_source;
        const glm::dvec3 mapped(facts.values[2]), vertex(facts.values[3].y, facts.values[3].z, facts.values[3].w);
        pixel.point.bias_normal = source == NormalSource::Mapped    ? mapped
                                  : source == NormalSource::Shading ? vertex
                                                                    : out.normal_ws;
        pixel.point.origin_ws = f.origin;
        pixel.point.in_map = facts.in_map();
        pixel.point.corners_ws = corners_ws(scene, out.id);
        if (f.gl.fitted[i].casts) {
            if (!seen) seen.emplace(f, place);
            pixel.taps = draw_taps(f, *seen, int(i));
            pixel.kernel = draw_kernel_facts(f, *seen, int(i));
        }
        out.lights.push_back(test_light_at_pixel(pixel, f.gl.fitted[i], f.settings, f.map_size, map, f.driver));
        out.lights.back().engine_bias = engine_bias(f.imported(i), f.settings);
        out.lights.back().evidence = draw_trials(f, place, int(i));
        out.lights.back().evidence.visibility = float(pixel.visibility);
        out.lights.back().causes = cause_context(f.settings, f.gl.fitted[i], int(i), f.map_size, f.mask_levels);
    }
    return out;
}

}  // namespace si
