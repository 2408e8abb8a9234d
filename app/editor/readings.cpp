#include "app/editor/readings.h"

#include <algorithm>

#include "ui/state/panels.h"

namespace si {
namespace {

constexpr int kHistogramBins = 200;

/// The range of the histogram: all that can be stored, or, when the greys are fitted, what they span with some room.
DepthHistogram histogram_of(const FloatImage& depth, const ViewSettings& v, const FrameResult& result) {
    double lo = 0, hi = 1;
    if (v.map_fit && v.map != int(MapView::Bands) && result.map_white > result.map_black) {
        const double room = 0.08 * (result.map_white - result.map_black);
        lo = result.map_black - room, hi = result.map_white + room;
    }
    return depth_histogram(depth, result.map_view_curve, MapView(v.map), kHistogramBins, lo, hi);
}

/// What the texels that a given camera reads depend on.
Settings texel_settings(const Settings& settings) {
    Settings s = settings;
    s.camera = {};
    s.view = {.light = settings.view.light, .face = settings.view.face};
    return s;
}

}  // namespace

void EditorReadings::clear() {
    facts_ = {.frozen_usage = facts_.frozen_usage};
    probed_pixel_.reset();
    probe_of_ = map_of_ = facts_of_ = links_of_ = exact_of_ = overlay_of_ = lost_of_ = 0;
}

bool EditorReadings::finish_tracing() const {
    dossier_.wait();
    return dossier_.ready();
}

ReadingFacts EditorReadings::facts() const {
    ReadingFacts out = facts_;
    out.dossiers.assign(dossier_.dossiers().begin(), dossier_.dossiers().end());
    out.sections = facts_.probe ? dossier_.sections() : nullptr;
    out.tracing_probe = facts_.probe && dossier_.tracing();
    return out;
}

bool EditorReadings::update(Renderer& renderer, const Scene& scene, const PictureState& state,
                            const EditorActions& actions, const FrameRequest& request, const FrameResult& result,
                            bool drawn) {
    if (drawn) ++frame_, facts_.lost_casters.clear();
    bool changed = update_lost(scene, state, result);
    changed |= update_map(renderer, state, actions, result);
    changed |= update_links(renderer, state, actions, result);
    changed |= update_exact(renderer, actions, result);
    changed |= update_overlay(renderer, state, actions, result);
    const bool probed = update_probe(renderer, scene, state, request);
    std::uint64_t bytes = 0;
    for (const auto& image : {facts_.map_values, facts_.map_coordinates, facts_.overlay_values})
        if (image) bytes += array_bytes(image->data);
    if (bytes != held_.bytes()) held_ = HeldMemory("numbers read back", bytes);
    changed |= dossier_.update(facts_.probe.get(), probed, scene, state.settings, renderer.driver());
    changed |= dossier_.update_sections(facts_.probe.get(), state.settings, state.tab == BottomTab::Probe);
    return changed || probed;
}

bool EditorReadings::update_lost(const Scene& scene, const PictureState& state, const FrameResult& result) {
    const int light = shown_light(state.settings);
    if (state.tab != BottomTab::Objects || light < 0 || lost_of_ == frame_) return false;
    lost_of_ = frame_;
    facts_.lost_casters = lost_casters(scene, state.settings, result.lights[std::size_t(light)]);
    return !facts_.lost_casters.empty();
}

bool EditorReadings::update_map(Renderer& renderer, const PictureState& state, const EditorActions& actions,
                                const FrameResult& result) {
    const bool there = result.map_view.texture != 0;
    const bool wanted = there && (actions.want_map_values || actions.want_map_facts);
    bool changed = false;
    if (!wanted) {
        // A reading of an earlier frame would be wrong; one of this frame may be asked for again.
        if (map_of_ != frame_) facts_.map_values.reset();
        if (!there || facts_of_ != frame_) facts_.map_facts.reset();
        return false;
    }
    if (map_of_ != frame_) {
        facts_.map_values = std::make_shared<const FloatImage>(renderer.read_map_view_depth(result));
        map_of_ = frame_;
        changed = true;
    }
    // Moments are no depths, of which the plots are.
    if (result.shown_map.channel > 0) facts_.map_facts.reset();
    if (actions.want_map_facts && result.shown_map.channel == 0 && facts_of_ != frame_) {
        facts_.map_facts = MapFacts{depth_statistics(*facts_.map_values, result.map_view_curve),
                                    histogram_of(*facts_.map_values, state.settings.view, result)};
        facts_of_ = frame_;
        changed = true;
    }
    return changed;
}

bool EditorReadings::update_overlay(Renderer& renderer, const PictureState& state, const EditorActions& actions,
                                    const FrameResult& result) {
    const auto pane = std::size_t(state.active_pane);
    if (!actions.want_overlay_values || pane >= result.panes.size() || !result.panes[pane].values.texture) {
        if (overlay_of_ != frame_) facts_.overlay_values.reset();
        return false;
    }
    if (overlay_of_ == frame_ && overlay_pane_ == int(pane)) return false;
    overlay_of_ = frame_;
    overlay_pane_ = int(pane);
    facts_.overlay_values = std::make_shared<const FloatImage>(renderer.read_float(result.panes[pane].values, 4));
    return true;
}

bool EditorReadings::update_links(Renderer& renderer, const PictureState& state, const EditorActions& actions,
                                  const FrameResult& result) {
    if (!actions.want_links || result.map_coordinates.texture == 0) {
        if (links_of_ == frame_ || !facts_.map_coordinates) return false;
        facts_.map_coordinates.reset();
        facts_.usage.reset();
        return true;
    }
    if (links_of_ == frame_) return false;
    links_of_ = frame_;
    facts_.map_coordinates = std::make_shared<const FloatImage>(renderer.read_float(result.map_coordinates, 4));
    facts_.usage = std::make_shared<const TexelUsage>(texel_usage(
        *facts_.map_coordinates, state.settings, result.map_resolution, shown_face(state.settings, result)));
    return true;
}

bool EditorReadings::update_exact(Renderer& renderer, const EditorActions& actions, const FrameResult& result) {
    if (!actions.want_exact_texels || result.texels_read.texture == 0) {
        if (exact_of_ == frame_ || !facts_.exact_utilisation) return false;
        facts_.exact_utilisation.reset();
        return true;
    }
    if (exact_of_ == frame_) return false;
    exact_of_ = frame_;
    facts_.exact_utilisation = exact_utilisation(renderer.read_float(result.texels_read, 1));
    return true;
}

bool EditorReadings::update_frozen(Renderer& renderer, const Scene& scene, const PictureState& state,
                                   const EditorActions& actions) {
    const Settings settings = texel_settings(state.settings);
    if (!state.frozen || settings != frozen_settings_ || scene.id != frozen_scene_) facts_.frozen_usage.reset();
    if (!state.frozen || facts_.frozen_usage || !actions.want_frozen_usage) return false;
    FrameRequest request;
    request.width = state.frozen->pixels.x;
    request.height = state.frozen->pixels.y;
    request.outputs = {.colour = false, .map_coordinates = true};
    frozen_settings_ = settings;
    frozen_scene_ = scene.id;
    Settings seen = state.settings;
    seen.camera = state.frozen->settings;
    const FrameResult result = renderer.render(scene, seen, request);
    facts_.frozen_usage = std::make_shared<const TexelUsage>();  // without a map nothing is read
    if (result.map_coordinates.texture == 0) return true;
    const FloatImage coordinates = renderer.read_float(result.map_coordinates, 4);
    facts_.frozen_usage = std::make_shared<const TexelUsage>(
        texel_usage(coordinates, state.settings, result.map_resolution, shown_face(state.settings, result)));
    return true;
}

bool EditorReadings::update_probe(Renderer& renderer, const Scene& scene, const PictureState& state,
                                  const FrameRequest& request) {
    if (!state.probe_pixel) {
        const bool had = bool(facts_.probe);
        facts_.probe.reset();
        probed_pixel_.reset();
        return had;
    }
    if (probe_of_ == frame_ && probed_pixel_ == state.probe_pixel) return false;
    probe_of_ = frame_;
    probed_pixel_ = state.probe_pixel;
    const glm::ivec2 pixel =
        glm::clamp(*state.probe_pixel, glm::ivec2(0), glm::ivec2(request.width, request.height) - 1);
    facts_.probe.reset();  // in case of an exception
    facts_.probe = std::make_shared<const Probe>(renderer.probe(scene, state.settings, request, pixel.x, pixel.y));
    return true;
}

}  // namespace si
