// Passes that upload the ray-traced reference, classify each pixel by it, and sum up the errors.
#include "renderer/passes/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "renderer/base/index_of.h"
#include "renderer/frame/causes.h"
#include "renderer/passes/camera_drawing.h"
#include "renderer/passes/moments.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/live_error.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

constexpr int kTile = 32;  ///< pixels along a tile's side, summed by one invocation
// The last four artefacts share numbers with unused classes: see tile_number() in error_tiles.frag.glsl.
static_assert(kArtefacts - 4 <= 4 * shared::ARTEFACT_LAYERS && index_of(Artefact::NoMap) == int(kArtefacts) - 4,
              "the sums of tiles have a number for each artefact");

using ReferenceTargets = ReferencePasses::Targets;

/// Uploads the reference's values; rows stay from the top.
void upload(const TracedReference& traced, ReferenceTargets& to) {
    const Reference& reference = *traced.reference;
    const std::size_t n = reference.state.size();
    std::vector<glm::vec4> pixels(n), more(n);
    // Some drivers lose NaN and infinity.
    const auto metres = [](const FloatImage& image, std::size_t i) {
        return image.data.empty() || std::isnan(image.data[i]) ? -1.f : std::max(image.data[i], 0.f);
    };
    const auto finite = [](float v) { return std::isfinite(v) ? v : 3e38f; };
    for (std::size_t i = 0; i < n; ++i) {
        const ReferencePixel t = reference_pixel(reference, i);
        pixels[i] = {reference.visibility.data[i], metres(reference.nearest_m, i), float(reference.state[i]),
                     float(t.noise)};
        more[i] = {metres(reference.blocker_m, i), reference.hard().data[i], finite(traced.runs->edge_m.data[i]),
                   finite(traced.runs->run_m.data[i])};
    }
    const auto put = [&](gl::Target& t, const char* label, const std::vector<glm::vec4>& data) {
        t.ensure(label, GL_RGBA32F, reference.width, reference.height);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(t.texture.id(), 0, 0, 0, reference.width, reference.height, GL_RGBA, GL_FLOAT, data.data());
    };
    put(to.reference, "reference", pixels);
    put(to.more_reference, "more of the reference", more);
}

Pass upload_pass(FrameState& f, ReferenceTargets& t) {
    return {.name = "reference uploaded",
            .category = PassCategory::Tool,
            .writes = {Result::Reference},
            .key = f.reference_content,
            .cached = &t.reference.key,
            .run = [&f, &t](PassInfo&) { upload(f.request.reference->traced, t); },
            .idle_reason = "no output needs the reference"};
}

/// Returns true when the light's map contains the whole scene or all possible receivers, or the light has no map.
bool map_holds_all(const FrameState& f, int number) {
    const auto light = std::size_t(number);
    if (light >= f.gl.fitted.size()) return false;
    const FittedLight& fitted = f.gl.fitted[light];
    if (!fitted.casts) return true;
    return fitted.type == LightType::Directional && f.settings.lights[light].fit != LightFit::Manual &&
           fitted.chooser.choice == ViewChoice::One && !fitted.is_perspective();
}

/// Returns true when taps outside the map may change visibility wrongly. They cannot where nothing lies outside and the
/// border counts as lit.
bool seams_matter(const FrameState& f, int light) {
    const MapSettings& m = f.settings.map;
    const bool lit = m.outside == Outside::Lit && (m.wrap == MapWrap::Border || m.wrap == MapWrap::Range);
    return !map_holds_all(f, light) || !lit;
}

/// Returns the defines for shaders that run trials: the kernel with other biases and on the unfiltered map. Comparison
/// and filtering by hardware samplers are done in the shader.
/// @param light light of the trials, shown or not
std::vector<gl::Define> trial_defines(const FrameState& f, int light) {
    const CauseContext c = cause_context(f.settings, f.gl.fitted[std::size_t(light)], light, f.map_size, f.mask_levels);
    std::vector<gl::Define> out = reference_defines(f);
    out.insert(out.end(), {{"LIGHT_INDEX", std::to_string(light)},
                           {"HAS_MAP", std::to_string(int(c.has_map))},
                           {"HAS_CONTACTS", std::to_string(int(c.has_contact))},
                           {"MAP_TRIALS", "1"},
                           {"SEAM_TRIALS", std::to_string(int(seams_matter(f, light)))},
                           {"FILTER_SAMPLER", "0"},
                           {"COMPARE_BY_HAND", "1"},
                           {"RASTER_BIAS", std::to_string(int(c.raster_bias))},
                           {"MASK_LEVELS", std::to_string(int(c.mask_levels))},
                           {"DEPTH_BLUR", std::to_string(int(c.depth_blur))},
                           {"READS_MOMENTS", std::to_string(int(c.moments))},
                           {"UNFILTERED_DIFFERS", std::to_string(int(c.unfiltered_differs()))}});
    return out;
}

Pass compare_pass(FrameState& f, ReferenceTargets& t) {
    Pass pass{.name = "pixels compared",
              .category = PassCategory::Tool,
              .reads = {Result::Visibility, Result::VisibleSurfaces, Result::Reference},
              .writes = {Result::Compared},
              .key = f.shown_light_key().value(),
              .cached = &t.classified.key,
              .idle_reason = "no output shows wrong pixels"};
    pass.run = [&f, &t](PassInfo& info) {
        t.causes_key = 0;
        t.classified.ensure("classified pixels", GL_RG32F, f.request.width, f.request.height);
        t.marks.ensure("marks of wrong pixels", GL_DEPTH_COMPONENT32F, f.request.width, f.request.height);
        const gl::Framebuffer framebuffer = gl::make_framebuffer("classified pixels", &t.classified, &t.marks);
        f.begin_fullscreen_pass(framebuffer.id(), f.request.width, f.request.height);
        glEnable(GL_DEPTH_TEST);  // without the test nothing is written
        glDepthFunc(GL_ALWAYS);
        glDepthMask(GL_TRUE);
        std::vector<gl::Define> extra = reference_defines(f);
        extra.push_back({"LIGHT_INDEX", std::to_string(f.settings.view.light)});
        extra.push_back({"MAP_HOLDS_ALL", map_holds_all(f, f.settings.view.light) ? "1" : "0"});
        f.use_fullscreen("passes/compare.frag.glsl", std::move(extra));
        FrameState::draw_fullscreen(info);
    };
    return pass;
}

/// Returns the pass that runs trials of the marked pixels. Each kind of error has a draw of its own, as a CPU
/// rasteriser executes both sides of a branch. The scene is drawn again where corners of triangles are read.
Pass causes_pass(FrameState& f, ReferenceTargets& t) {
    Pass pass{.name = "causes found",
              .category = PassCategory::Tool,
              .reads = kernel_inputs(f),
              .writes = {Result::Classified},
              .key = f.shown_light_key().value(),
              .cached = &t.causes_key,
              .idle_reason = "no output shows causes"};
    pass.reads.insert(pass.reads.end(), {Result::Compared, Result::Visibility, Result::VisibleSurfaces,
                                         Result::UnfilteredMap, Result::Reference});
    pass.run = [&f, &t](PassInfo& info) {
        const gl::Framebuffer framebuffer = gl::make_framebuffer("classified pixels", &t.classified, &t.marks);
        const auto draw = [&](float mark, const char* fragment, std::vector<gl::Define> kind) {
            const std::vector<gl::Define> trials = trial_defines(f, f.settings.view.light);
            kind.insert(kind.end(), trials.begin(), trials.end());
            const bool corners = f.reads_corners(fragment);
            if (corners)
                f.begin_camera_pass(framebuffer.id());
            else
                f.begin_fullscreen_pass(framebuffer.id(), f.request.width, f.request.height);
            glEnable(GL_DEPTH_TEST);
            glDepthFunc(GL_EQUAL);
            glDepthMask(GL_FALSE);
            glDepthRangef(mark, mark);
            if (corners) return f.draw_from_camera(fragment, kind, info);
            f.use_fullscreen(fragment, std::move(kind));
            FrameState::draw_fullscreen(info);
        };
        draw(shared::MARK_FALSE_LIGHT, "passes/causes.frag.glsl",
             {{"FOR_FALSE_LIGHT", "1"}, {"FOR_FALSE_SHADOW", "0"}});
        draw(shared::MARK_FALSE_SHADOW, "passes/causes.frag.glsl",
             {{"FOR_FALSE_LIGHT", "0"}, {"FOR_FALSE_SHADOW", "1"}});
        if (source_of(f.settings, f.settings.view.light).needs.map)
            draw(shared::MARK_FAINT, "passes/faint_acne.frag.glsl",
                 {{"FOR_FALSE_LIGHT", "0"}, {"FOR_FALSE_SHADOW", "1"}});
        glDepthRangef(0, 1);
        glDepthMask(GL_TRUE);
    };
    return pass;
}

Pass evidence_pass(FrameState& f, ReferenceTargets& t) {
    Pass pass{.name = "trials of all pixels",
              .category = PassCategory::Tool,
              .reads = kernel_inputs(f),
              .writes = {Result::Evidence},
              .key = f.shown_light_key().add(f.reference.met).value(),
              .cached = &t.evidence[0].key,
              .idle_reason = "no output needs the trials"};
    pass.reads.push_back(Result::UnfilteredMap);
    if (f.reference.met) pass.reads.push_back(Result::Reference);
    pass.run = [&f, &t](PassInfo& info) {
        CameraDrawing pass_into(f, "evidence", GL_RGBA32F, t.evidence);
        pass_into.clear(glm::vec4(0));
        draw_evidence(f, f.settings.view.light, f.reference.met, info);
    };
    return pass;
}

/// Returns the sums of all tiles, in double precision.
/// @param has_map the classified light has a shadow map
PixelSums read_tiles(const gl::Target& tiles, bool has_map) {
    const std::size_t per_layer = std::size_t(tiles.width) * std::size_t(tiles.height);
    const auto values = gl::read_texture<glm::vec4>(tiles.texture.id(), per_layer * std::size_t(shared::TILE_LAYERS),
                                                    GL_RGBA, GL_FLOAT);
    glm::dvec4 layers[shared::TILE_LAYERS] = {};
    for (std::size_t i = 0; i < values.size(); ++i) layers[i / per_layer] += glm::dvec4(values[i]);
    PixelSums sums;
    for (std::size_t a = 0; a + 4 < kArtefacts; ++a) {
        const int layer = int(a) / 4, number = int(a) % 4;
        sums.dark[a] = layers[shared::TILE_DARK + layer][number];
        sums.bright[a] = layers[shared::TILE_BRIGHT + layer][number];
    }
    if (!has_map)
        for (auto* of : {&sums.dark, &sums.bright})
            (*of)[std::size_t(Artefact::NoMap)] = std::exchange((*of)[std::size_t(Artefact::None)], 0);
    const auto moves = [](auto& of, Artefact from, Artefact to) {
        of[std::size_t(to)] = std::exchange(of[std::size_t(from)], 0);
    };
    moves(sums.bright, Artefact::Acne, Artefact::PeterPanningRaster);
    moves(sums.dark, Artefact::Leak, Artefact::Contact);
    moves(sums.bright, Artefact::Filter, Artefact::LightBleeding);
    sums.visible_acne = std::exchange(sums.bright[std::size_t(Artefact::OffsetShadow)], 0);
    sums.any_leak = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec4 &noted = layers[shared::TILE_NOTED], &means = layers[shared::TILE_SUMS];
    sums.outside = noted[0];
    sums.any_acne = noted[1];
    sums.within_noise = noted[2];
    sums.either = noted[3];
    sums.absolute = means[0];
    sums.squares = means[1];
    sums.sum = means[2];
    sums.both = means[3];
    return sums;
}

Pass sums_pass(FrameState& f, ReferenceTargets& t) {
    const bool has_map = source_of(f.settings, f.settings.view.light).needs.map;
    Pass pass{.name = "error metrics",
              .category = PassCategory::Tool,
              .reads = {Result::Classified, Result::Reference},
              .writes = {Result::Error},
              .key = Key().add(has_map).value(),
              .cached = &t.error_tiles.key,
              .idle_reason = "not needed: no output shows error metrics"};
    pass.run = [&f, &t, has_map](PassInfo& info) {
        const Reference& reference = *f.request.reference->traced.reference;
        const int across = (reference.width + kTile - 1) / kTile, down = (reference.height + kTile - 1) / kTile;
        gl::Target& tiles = t.error_tiles;
        tiles.ensure("errors of tiles", GL_RGBA32F, across, down, shared::TILE_LAYERS);
        const gl::Framebuffer framebuffer = gl::make_layers_framebuffer("errors of tiles", tiles);
        f.begin_fullscreen_pass(framebuffer.id(), across, down);
        std::vector<gl::Define> extra = reference_defines(f);
        extra.push_back({"TILE", std::to_string(kTile)});
        f.use_fullscreen("passes/error_tiles.frag.glsl", std::move(extra));
        FrameState::draw_fullscreen(info);
        t.error = std::make_shared<const LiveError>(LiveError{metrics_of(read_tiles(tiles, has_map), reference)});
    };
    return pass;
}

std::string upper(std::string_view key) {
    std::string out;
    for (const char c : key) out += char(std::toupper(static_cast<unsigned char>(c)));
    return out;
}

}  // namespace

std::vector<gl::Define> reference_defines(const FrameState& f) {
    const int step = f.request.reference ? f.request.reference->step : 1;
    std::vector<gl::Define> out{{"REFERENCE_STEP", std::to_string(step)},
                                {"REFERENCE_ROWS", std::to_string(f.request.height)}};
    out.push_back({"ARTEFACT_NONE", "0"});
    std::string colours;
    for (const ArtefactStyle& style : artefact_styles()) {
        out.push_back({"ARTEFACT_" + upper(style.key), std::to_string(int(style.artefact))});
        colours += fmt::format("{}vec3({:.6f}, {:.6f}, {:.6f})", colours.empty() ? "" : ", ", style.rgb[0] / 255.0,
                               style.rgb[1] / 255.0, style.rgb[2] / 255.0);
    }
    out.push_back({"ARTEFACT_COLOURS", "vec3[](" + colours + ")"});
    return out;
}

std::string missing_reference_reason(const FrameState& f) {
    return f.reference.key == 0 && !f.gl.fitted.empty() ? "nothing in the frame needs the reference"
                                                        : "the reference of this frame is not traced";
}

void ReferencePasses::declare(FrameState& f) {
    Targets& t = targets_;
    f.plan.place_result(Result::Reference, {&t.reference, shared::UNIT_REFERENCE});
    f.plan.place_result(Result::Reference, {&t.more_reference, shared::UNIT_MORE_REFERENCE});
    f.plan.place_result(Result::Compared, {&t.classified});
    f.plan.place_result(Result::Classified, {&t.classified, shared::UNIT_CLASSIFIED});
    f.plan.place_result(Result::Error, {&t.error_tiles});
    for (const gl::Target& image : t.evidence) f.plan.place_result(Result::Evidence, {&image});
    std::array<Pass, 4> passes{upload_pass(f, t), compare_pass(f, t), causes_pass(f, t), sums_pass(f, t)};
    for (Pass& pass : passes) {
        if (!f.reference.met) {
            pass.unneeded = missing_reference_reason(f);
            pass.run = nullptr;
            pass.cached = nullptr;
        }
        f.plan.add_pass(std::move(pass));
    }
    f.plan.add_pass(evidence_pass(f, t));
}

void draw_evidence(const FrameState& f, int light, bool reference_known, PassInfo& info) {
    std::vector<gl::Define> extra = trial_defines(f, light);
    extra.push_back({"REFERENCE_KNOWN", reference_known ? "1" : "0"});
    f.draw_from_camera("passes/evidence.frag.glsl", extra, info);
}

}  // namespace si
