#include "app/editor/read_back.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/gl/target.h"
#include "ui/state/panels.h"

namespace si {
namespace {

constexpr int kHistogramBins = 200;

/// Returns the range of the histogram: all storable values, or, with fitted greys, their range with a margin.
DepthHistogram histogram_of(const FloatImage& depth, const ViewSettings& v, const FrameResult& result) {
    double lo = 0, hi = 1;
    if (result.map_fitted && result.map_white > result.map_black) {
        const double room = 0.08 * (result.map_white - result.map_black);
        lo = result.map_black - room;
        hi = result.map_white + room;
    }
    return depth_histogram(depth, result.map_view_curve, v.map, kHistogramBins, lo, hi);
}

/// Returns the settings that the texels read by a camera depend on.
Settings texel_settings(const Settings& settings) {
    Settings s = settings;
    s.camera = {};
    s.view = {.light = settings.view.light, .face = settings.view.face};
    return s;
}

}  // namespace

void EditorReadBack::clear() {
    facts_ = {.frozen_usage = facts_.frozen_usage};
    probed_pixel_.reset();
    probe_of_ = map_of_ = facts_of_ = links_of_ = exact_of_ = overlay_of_ = lost_of_ = loupe_of_ = 0;
}

ReadBackFacts EditorReadBack::facts() const {
    ReadBackFacts out = facts_;
    out.diagnoses.assign(diagnosis_.diagnoses().begin(), diagnosis_.diagnoses().end());
    out.sections = facts_.probe ? diagnosis_.sections() : nullptr;
    out.tracing_probe = facts_.probe && diagnosis_.tracing();
    return out;
}

bool EditorReadBack::update(Renderer& renderer, const Scene& scene, const PictureState& state,
                            const EditorRequests& requests, const FrameRequest& request, const FrameResult& result,
                            bool drawn) {
    if (drawn) {
        ++frame_;
        facts_.lost_casters.clear();
    }
    bool changed = update_lost(scene, state, result);
    changed |= update_map(renderer, state, requests, result);
    changed |= update_links(renderer, state, requests, result);
    changed |= update_exact(renderer, requests, result);
    changed |= update_overlay(renderer, state, requests, result);
    changed |= update_loupe(state, result);
    const bool probed = update_probe(renderer, scene, state, request, result);
    std::uint64_t bytes = 0;
    for (const auto& image : {facts_.map_values, facts_.map_coordinates, facts_.overlay_values})
        if (image) bytes += array_bytes(image->data);
    if (bytes != held_.bytes()) held_ = TrackedMemory("numbers read back", bytes);
    changed |= diagnosis_.update(facts_.probe.get(), probed, scene, state.settings, renderer.driver());
    changed |= diagnosis_.update_sections(facts_.probe.get(), state.settings, state.shows(Page::Pixel));
    return changed || probed;
}

bool EditorReadBack::update_lost(const Scene& scene, const PictureState& state, const FrameResult& result) {
    const int light = shown_light(state.settings);
    if (!state.shows(Page::Objects) || light < 0 || !is_due(lost_of_)) return false;
    facts_.lost_casters = lost_casters(scene, state.settings, result.lights[std::size_t(light)]);
    return !facts_.lost_casters.empty();
}

bool EditorReadBack::update_map(Renderer& renderer, const PictureState& state, const EditorRequests& requests,
                                const FrameResult& result) {
    const bool there = result.map_view.texture != 0;
    const bool wanted = there && (requests.want_map_values || requests.want_map_facts);
    bool changed = false;
    if (!wanted) {
        // Numbers of an earlier frame would be wrong; those of this frame may be requested again.
        if (map_of_ != frame_) facts_.map_values.reset();
        if (!there || facts_of_ != frame_) facts_.map_facts.reset();
        return false;
    }
    if (is_due(map_of_)) {
        facts_.map_values = std::make_shared<const FloatImage>(renderer.read_map_view_depth(result));
        changed = true;
    }
    // The plots show depths, not moments.
    if (result.shown_map.channel > 0) facts_.map_facts.reset();
    if (requests.want_map_facts && result.shown_map.channel == 0 && is_due(facts_of_)) {
        facts_.map_facts = MapPlots{depth_statistics(*facts_.map_values, result.map_view_curve),
                                    histogram_of(*facts_.map_values, state.settings.view, result)};
        changed = true;
    }
    return changed;
}

bool EditorReadBack::update_overlay(Renderer& renderer, const PictureState& state, const EditorRequests& requests,
                                    const FrameResult& result) {
    const auto pane = std::size_t(state.active_pane);
    if (!requests.want_overlay_values || pane >= result.panes.size() || !result.panes[pane].values.texture) {
        if (overlay_of_ != frame_) facts_.overlay_values.reset();
        return false;
    }
    if (overlay_of_ == frame_ && overlay_pane_ == int(pane)) return false;
    overlay_of_ = frame_;
    overlay_pane_ = int(pane);
    facts_.overlay_values = std::make_shared<const FloatImage>(renderer.read_float(result.panes[pane].values, 4));
    return true;
}

bool EditorReadBack::update_links(Renderer& renderer, const PictureState& state, const EditorRequests& requests,
                                  const FrameResult& result) {
    if (!requests.want_links || result.map_coordinates.texture == 0) {
        if (links_of_ == frame_ || !facts_.map_coordinates) return false;
        facts_.map_coordinates.reset();
        facts_.usage.reset();
        return true;
    }
    if (!is_due(links_of_)) return false;
    facts_.map_coordinates = std::make_shared<const FloatImage>(renderer.read_float(result.map_coordinates, 4));
    facts_.usage = std::make_shared<const TexelUsage>(
        texel_usage(*facts_.map_coordinates, state.settings, result.map_size, shown_face(state.settings, result)));
    return true;
}

bool EditorReadBack::update_exact(Renderer& renderer, const EditorRequests& requests, const FrameResult& result) {
    if (!requests.want_exact_texels || result.texels_read.texture == 0) {
        if (exact_of_ == frame_ || !facts_.exact_utilisation) return false;
        facts_.exact_utilisation.reset();
        return true;
    }
    if (!is_due(exact_of_)) return false;
    facts_.exact_utilisation = exact_utilisation(renderer.read_float(result.texels_read, 1));
    return true;
}

bool EditorReadBack::update_frozen(Renderer& renderer, const Scene& scene, const PictureState& state,
                                   const EditorRequests& requests) {
    const Settings settings = texel_settings(state.settings);
    if (!state.frozen || settings != frozen_settings_ || scene.id != frozen_scene_) facts_.frozen_usage.reset();
    if (!state.frozen || facts_.frozen_usage || !requests.want_frozen_usage) return false;
    const FrameRequest request{.width = state.frozen->pixels.x,
                               .height = state.frozen->pixels.y,
                               .outputs = {.colour = false, .map_coordinates = true}};
    frozen_settings_ = settings;
    frozen_scene_ = scene.id;
    Settings seen = state.settings;
    seen.camera = state.frozen->settings;
    const FrameResult result = renderer.render(scene, seen, request);
    facts_.frozen_usage = std::make_shared<const TexelUsage>();  // without a map no texel is read
    if (result.map_coordinates.texture == 0) return true;
    const FloatImage coordinates = renderer.read_float(result.map_coordinates, 4);
    facts_.frozen_usage = std::make_shared<const TexelUsage>(
        texel_usage(coordinates, state.settings, result.map_size, shown_face(state.settings, result)));
    return true;
}

bool EditorReadBack::update_probe(Renderer& renderer, const Scene& scene, const PictureState& state,
                                  const FrameRequest& request, const FrameResult& result) {
    std::optional<glm::ivec2> pixel = state.probe_pixel;
    AnchorPlace place = AnchorPlace::Seen;
    const bool sticks = pixel && state.probe_anchor && state.probe_anchor->pixel == *pixel;
    if (sticks) {
        pixel = anchored_pixel(*state.probe_anchor, result.camera, request.width, request.height);
        if (!pixel) place = AnchorPlace::Outside;
    }
    if (!pixel) {
        const bool changed = facts_.probe || facts_.anchor_place != place;
        facts_.anchor_place = place;
        facts_.probe.reset();
        probed_pixel_.reset();
        return changed;
    }
    if (probe_of_ == frame_ && probed_pixel_ == pixel) return false;
    probe_of_ = frame_;
    probed_pixel_ = pixel;
    const glm::ivec2 at = glm::clamp(*pixel, glm::ivec2(0), glm::ivec2(request.width, request.height) - 1);
    facts_.probe.reset();  // the old probe must not stay if probing throws
    facts_.probe = std::make_shared<const Probe>(renderer.probe(scene, state.settings, request, at.x, at.y));
    if (sticks && hides(*facts_.probe, *state.probe_anchor)) place = AnchorPlace::Hidden;
    facts_.anchor_place = place;
    return true;
}

bool EditorReadBack::update_loupe(const PictureState& state, const FrameResult& result) {
    const auto pane = std::size_t(state.active_pane);
    const auto at = state.loupe_pixel;
    if (!at || pane >= result.panes.size() || result.panes[pane].picture.texture == 0) {
        const bool had = bool(facts_.loupe);
        facts_.loupe.reset();
        return had;
    }
    if (loupe_of_ == frame_ && loupe_pane_ == int(pane) && facts_.loupe && facts_.loupe->at == *at) return false;
    loupe_of_ = frame_;
    loupe_pane_ = int(pane);
    const Image& picture = result.panes[pane].picture;
    constexpr int kSide = 2 * kLoupeRadiusPixels + 1;
    auto loupe = std::make_shared<LoupeFacts>(LoupeFacts{.at = *at, .pixels = {kSide, kSide, {}}});
    loupe->pixels.data.resize(std::size_t(kSide) * kSide * 4);
    const glm::ivec2 size(picture.width, picture.height);
    const glm::ivec2 lo = glm::clamp(*at - kLoupeRadiusPixels, glm::ivec2(0), size);
    const glm::ivec2 hi = glm::clamp(*at + kLoupeRadiusPixels + 1, glm::ivec2(0), size), n = hi - lo;
    if (n.x > 0 && n.y > 0) {
        std::vector<std::uint8_t> read(std::size_t(n.x) * std::size_t(n.y) * 4);
        gl::prepare_read_back();
        glGetTextureSubImage(picture.texture, 0, lo.x, size.y - hi.y, 0, n.x, n.y, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                             GLsizei(read.size()), read.data());
        for (int y = lo.y; y < hi.y; ++y)
            for (int x = lo.x; x < hi.x; ++x) {
                const auto* from = &read[(std::size_t(hi.y - 1 - y) * std::size_t(n.x) + std::size_t(x - lo.x)) * 4];
                const glm::ivec2 to = glm::ivec2(x, y) - *at + kLoupeRadiusPixels;
                auto* pixel = &loupe->pixels.data[(std::size_t(to.y) * kSide + std::size_t(to.x)) * 4];
                std::copy_n(from, 3, pixel);
                pixel[3] = 255;
            }
    }
    if (const Image& v = result.visibility;
        v.texture != 0 && glm::all(glm::greaterThanEqual(*at, glm::ivec2(0))) && at->x < v.width && at->y < v.height) {
        float visibility = 1;
        glGetTextureSubImage(v.texture, 0, at->x, v.height - 1 - at->y, 0, 1, 1, 1, GL_RED, GL_FLOAT,
                             GLsizei(sizeof(visibility)), &visibility);
        loupe->visibility = visibility;
    }
    facts_.loupe = std::move(loupe);
    return true;
}

}  // namespace si
