// The traced truth on the GPU: uploaded, each pixel judged by it, the judgements summed up.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "renderer/frame_state.h"
#include "renderer/measure/artefact_picture.h"
#include "renderer/reference/error_task.h"
#include "renderer/reference/live_error.h"
#include "renderer/reference/truth_picture.h"

namespace si {
namespace {

constexpr int kTile = 32;       ///< pixels of the truth a side, summed by one invocation
constexpr int kTileValues = 5;  ///< four numbers each

constexpr const char* kUntraced = "the truth about this frame is not traced";

/// What EdgeFact and PixelState are for the shader; rows stay from the top.
void upload(const TruthPicture& picture, bool with_edges, Resources& gl) {
    const Truth& truth = *picture.traced.truth;
    std::vector<glm::vec4> pixels(truth.state.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const float nearest = truth.nearest_m.data.empty() ? std::numeric_limits<float>::quiet_NaN() : truth.nearest_m.data[i];
        // Not all drivers keep NaN.
        pixels[i] = {truth.visibility.data[i], std::isnan(nearest) ? -1.f : std::max(nearest, 0.f),
                     float(truth.state[i]), 0};
    }
    const auto put = [&](gl::Target& t, const char* label, GLenum internal, GLenum format, const void* data) {
        t.ensure(label, internal, truth.width, truth.height);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(t.texture.id(), 0, 0, 0, truth.width, truth.height, format, GL_FLOAT, data);
    };
    put(gl.truth, "truth", GL_RGBA32F, GL_RGBA, pixels.data());
    const bool known = with_edges && picture.edges;
    const EdgeImage unknown(known ? 0 : pixels.size(), kUnknownEdge);
    put(gl.edges, "true edges", GL_RG32F, GL_RG, known ? picture.edges->data() : unknown.data());
}

Pass upload_pass(FrameState& f) {
    Pass pass;
    pass.name = "truth uploaded";
    pass.writes = {"truth"};
    pass.idle_reason = "nothing asks for the truth";
    pass.key = f.truth_content;
    pass.cached = &f.gl.truth.key;
    pass.run = [&f](PassInfo&) {
        const TruthPicture& truth = *f.request.truth;
        upload(truth, truth.edges_key == f.truth.edges_key, f.gl);
    };
    return pass;
}

std::uint64_t judged_key(const FrameState& f) {
    Key key = f.camera_key;
    key.add(f.geometry_key).add(f.lights_key).add(f.maps_key).add(f.settings.view.light).add(f.truth_content);
    return key.add(kernel_reach_texels(f.settings)).add(f.gl.programs.source().generation()).value();
}

Pass judge_pass(FrameState& f) {
    Pass pass;
    pass.name = "pixels judged";
    pass.reads = {"visibility", "shadow maps", "truth"};
    pass.writes = {"judged"};
    pass.idle_reason = "nothing asks what is wrong";
    pass.key = judged_key(f);
    pass.cached = &f.gl.judged.key;
    pass.run = [&f](PassInfo& info) {
        f.gl.judged.ensure("judged pixels", GL_RGBA32F, f.request.width, f.request.height);
        f.gl.judged_framebuffer = gl::make_framebuffer("judged pixels", &f.gl.judged, &f.gl.camera_depth);
        const GLuint framebuffer = f.gl.judged_framebuffer.id();
        f.begin_camera_pass(framebuffer);
        const glm::vec4 nothing(0);
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &nothing.x);
        glBindTextureUnit(kVisibility, f.gl.visibility.texture.id());
        bind_truth(f);
        std::vector<gl::Define> extra = truth_defines(f);
        extra.push_back({"LIGHT_INDEX", std::to_string(f.settings.view.light)});
        f.draw_from_camera("passes/judge.frag.glsl", extra, info);
    };
    return pass;
}

/// The sums of all tiles, in double.
struct Sums {
    double v[kTileValues][4] = {};
    std::size_t count(int target, int channel) const { return std::size_t(std::llround(v[target][channel])); }
};

Sums read_tiles(const gl::Target& tiles) {
    const std::size_t per_layer = std::size_t(tiles.width) * std::size_t(tiles.height);
    std::vector<glm::vec4> values(per_layer * kTileValues);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(tiles.texture.id(), 0, GL_RGBA, GL_FLOAT, GLsizei(values.size() * sizeof(glm::vec4)), values.data());
    Sums sums;
    for (int t = 0; t < kTileValues; ++t)
        for (std::size_t i = 0; i < per_layer; ++i)
            for (int c = 0; c < 4; ++c) sums.v[t][c] += values[std::size_t(t) * per_layer + i][c];
    return sums;
}

LiveError error_of(const Sums& s, const Truth& truth) {
    LiveError out;
    ErrorMetrics& m = out.metrics;
    m.pixels = truth.pixels;
    m.counted = truth.counted();
    const double n = m.counted > 0 ? double(m.counted) : 1;
    m.false_shadow = s.v[0][0] / n, m.false_light = s.v[0][1] / n, m.outside_map = s.v[0][2] / n, m.any_acne = s.v[0][3] / n;
    m.acne = s.v[1][0] / n, m.leak = s.v[1][1] / n;
    m.boundary_false_shadow = s.v[1][2] / n, m.boundary_false_light = s.v[1][3] / n;
    m.outside_false_shadow = s.v[2][0] / n, m.outside_false_light = s.v[2][1] / n;
    m.mae = s.v[3][0] / n, m.rmse = std::sqrt(s.v[3][1] / n), m.signed_mean = s.v[3][2] / n;
    if (s.v[4][0] > 0) m.iou = s.v[3][3] / s.v[4][0];
    m.boundary_px_mean = m.boundary_px_p95 = m.boundary_px_max = std::numeric_limits<double>::quiet_NaN();
    out.undecided = s.count(2, 2), out.undecided_wrong = s.count(2, 3);
    const auto set = [&](Artefact a, std::size_t pixels) { m.artefacts[std::size_t(a)] = pixels; };
    set(Artefact::Acne, s.count(1, 0));
    set(Artefact::EdgeAliasing, s.count(1, 2) + s.count(1, 3));
    set(Artefact::OutsideMap, s.count(0, 2));
    set(Artefact::PeterPanning, s.count(4, 1));
    set(Artefact::LostCaster, s.count(4, 2));
    set(Artefact::Leak, s.count(4, 3));
    std::size_t wrong = out.undecided_wrong;
    for (std::size_t a = 1; a < kArtefacts; ++a) wrong += m.artefacts[a];
    set(Artefact::None, truth.state.size() - wrong);
    return out;
}

Pass sums_pass(FrameState& f) {
    Pass pass;
    pass.name = "errors summed up";
    pass.reads = {"judged", "truth"};
    pass.writes = {"error"};
    pass.idle_reason = "nobody asks for numbers";
    Key key;
    pass.key = key.add(judged_key(f)).add("sums").value();
    pass.cached = &f.gl.error_tiles.key;
    pass.run = [&f](PassInfo& info) {
        const Truth& truth = *f.request.truth->traced.truth;
        const int across = (truth.width + kTile - 1) / kTile, down = (truth.height + kTile - 1) / kTile;
        gl::Target& tiles = f.gl.error_tiles;
        if (tiles.ensure("errors of tiles", GL_RGBA32F, across, down, kTileValues) || !f.gl.error_tiles_framebuffer) {
            f.gl.error_tiles_framebuffer = gl::Framebuffer::create("errors of tiles");
            GLenum buffers[kTileValues];
            for (int i = 0; i < kTileValues; ++i) {
                buffers[i] = GL_COLOR_ATTACHMENT0 + GLenum(i);
                glNamedFramebufferTextureLayer(f.gl.error_tiles_framebuffer.id(), buffers[i], tiles.texture.id(), 0, i);
            }
            glNamedFramebufferDrawBuffers(f.gl.error_tiles_framebuffer.id(), kTileValues, buffers);
        }
        f.begin_fullscreen_pass(f.gl.error_tiles_framebuffer.id(), across, down);
        std::vector<gl::Define> extra = truth_defines(f);
        extra.push_back({"TILE", std::to_string(kTile)});
        glUseProgram(f.program("passes/fullscreen.vert.glsl", "passes/error_tiles.frag.glsl", std::move(extra)));
        bind_truth(f);
        FrameState::draw_fullscreen(info);
        f.gl.error = std::make_shared<const LiveError>(error_of(read_tiles(tiles), truth));
    };
    return pass;
}

std::string upper(std::string_view key) {
    std::string out;
    for (const char c : key) out += char(std::toupper(static_cast<unsigned char>(c)));
    return out;
}

}  // namespace

std::vector<gl::Define> truth_defines(const FrameState& f) {
    const int step = f.request.truth ? f.request.truth->step : 1;
    std::vector<gl::Define> out{{"TRUTH_STEP", std::to_string(step)}, {"TRUTH_ROWS", std::to_string(f.request.height)}};
    out.push_back({"ARTEFACT_NONE", "0"});
    std::string colours;
    for (const ArtefactStyle& style : artefact_styles()) {
        out.push_back({"ARTEFACT_" + upper(style.key), std::to_string(int(style.artefact))});
        colours += fmt::format("{}vec3({:.6f}, {:.6f}, {:.6f})", colours.empty() ? "" : ", ", style.rgb[0] / 255.0,
                               style.rgb[1] / 255.0, style.rgb[2] / 255.0);
    }
    const auto& u = kUndecidedRgb;
    colours += fmt::format(", vec3({:.6f}, {:.6f}, {:.6f})", u[0] / 255.0, u[1] / 255.0, u[2] / 255.0);
    out.push_back({"ARTEFACT_UNDECIDED", std::to_string(kArtefacts)});
    out.push_back({"ARTEFACT_COLOURS", "vec3[](" + colours + ")"});
    out.push_back({"EDGE_REACH_TEXELS", fmt::format("{:.1f}", kernel_reach_texels(f.settings) + 1)});
    return out;
}

void bind_truth(const FrameState& f) {
    glBindTextureUnit(kTruth, f.gl.truth.texture.id());
    glBindTextureUnit(kEdges, f.gl.edges.texture.id());
    glBindTextureUnit(kJudged, f.gl.judged.texture.id());
}

void add_truth_passes(FrameState& f, std::vector<Pass>& plan) {
    std::array<Pass, 3> passes{upload_pass(f), judge_pass(f), sums_pass(f)};
    for (Pass& pass : passes) {
        if (!f.truth.met) {
            pass.unneeded = kUntraced;
            pass.run = nullptr;
            pass.cached = nullptr;
        }
        plan.push_back(std::move(pass));
    }
}

}  // namespace si
