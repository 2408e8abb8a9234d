#include "ui/state/quick_changes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "renderer/advise/fixes.h"
#include "renderer/base/index_of.h"
#include "renderer/base/lengths_text.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/measure/axes.h"
#include "renderer/reference/live_error.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/param.h"
#include "ui/state/editor_ui.h"
#include "ui/state/panels.h"
#include "ui/state/shortcuts.h"

namespace si {
namespace {

/// Returns the centre of the texel that contains `at`, 0..1.
double middle(double at, int texels) {
    return (std::floor(at * texels) + 0.5) / texels;
}

std::optional<TexelPlace> hovered_place(const EditorState& state, const EditorFrame& frame) {
    const FloatImage* c = frame.map_coordinates;
    const auto& at = state.viewport.hovered_pixel;
    if (!c || !at || at->x < 0 || at->y < 0 || at->x >= c->width || at->y >= c->height) return {};
    const MapSize n = frame.result->map_size;
    const double u = c->at(at->x, at->y, 0), v = c->at(at->x, at->y, 1);
    if (c->at(at->x, at->y, 3) <= 0 || n.shortest() <= 0 || !(u >= 0 && u < 1 && v >= 0 && v < 1)) return {};
    return TexelPlace{shown_light(state.settings), int(c->at(at->x, at->y, 2)), middle(u, n.width),
                      middle(v, n.height)};
}

std::optional<TexelPlace> probed_place(const EditorState& state, const EditorFrame& frame) {
    const MapSize n = frame.result->map_size;
    if (!state.probe_pixel || !frame.probe || !frame.probe->hit || n.shortest() <= 0) return {};
    for (const Probe::PerLight& p : frame.probe->lights)
        if (p.light == shown_light(state.settings) && p.place == MapPlace::Inside)
            return TexelPlace{p.light, p.face, (p.texel.x + 0.5) / n.width, (p.texel.y + 0.5) / n.height};
    return {};
}

/// Returns true while the probed pixel's verdict belongs to an earlier picture or is not known yet, or a pixel is
/// searched.
bool verdict_follows(const EditorState& state, const EditorFrame& frame) {
    if (state.artefact_tour.waits_for != 0 || frame.verdict_follows || frame.tracing_probe) return true;
    if (!state.probe_pixel) return false;
    return !frame.probe && frame.anchor_place != AnchorPlace::Outside;
}

/// Returns true while the panel Improve is shown and puts the probed pixel right.
bool improves_pixel(const EditorState& state) {
    return state.shows(Page::Improve) && state.improve.mode == ImproveMode::Pixel;
}

}  // namespace

void show_pixel(EditorState& state) {
    if (!improves_pixel(state)) state.window.open_page = Page::Pixel;
}

void remove_bias(Settings& settings) {
    if (bias_of(settings).gives_needed_bias) set_setting(settings, "bias.kind", "constant");
    BiasSettings& b = settings.bias;
    b.constant = b.slope = b.normal = b.raster_slope = b.raster_units = 0;
}

void next_light_type(Settings& settings) {
    const int light = shown_light(settings);
    if (light < 0) return;
    LightType& type = settings.lights[std::size_t(light)].type;
    type = next_of(type, int(find_setting("light.type")->param->choices().size()));
}

void scale_resolution(Settings& settings, bool twice) {
    const Param& p = *find_setting("map.resolution")->param;
    int& n = settings.map.resolution;
    n = std::clamp(twice ? n * 2 : n / 2, int(p.min), int(p.max));
}

void apply_trial(EditorState& state, const Trial& trial) {
    set_settings(state.settings, trial.changes);
    state.predicted = {measured_settings(state.settings), wrong_pixels(trial.metrics), trial.metrics.mae};
}

void check_prediction(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    if (!state.predicted) return;
    if (measured_settings(state.settings) != state.predicted->settings) return state.predicted.reset();
    requests.want_error = true;
    if (!frame.error || !frame.reference || !frame.reference->current || !frame.drawn) return;
    if (measured_settings(*frame.drawn) != state.predicted->settings) return;
    const std::size_t wrong = wrong_pixels(frame.error->metrics);
    const double mae = frame.error->metrics.mae;
    state.log.add(LogKind::Info,
                  fmt::format("Applied: {} px wrong and mean error {} were predicted; {} and {} are measured",
                              state.predicted->wrong, digits_text(state.predicted->mae), wrong, digits_text(mae)));
    state.predicted.reset();
}

void apply_fix(EditorState& state, const EditorFrame& frame) {
    const bool wrong = std::ranges::any_of(frame.diagnoses, [&](const PixelDiagnosis& d) {
        return d.light == shown_light(state.settings) && d.wants_fix();
    });
    const FixSearch& search = frame.pixel_fixes;
    const bool known = search.table && search.current && search.pixel == state.probe_pixel && !search.running;
    const Trial* const fix = verdict_follows(state, frame) ? nullptr : found_fix(search, state.probe_pixel);
    state.probe_panel.fix_waits = frame.result && !fix && (verdict_follows(state, frame) || (wrong && !known));
    if (state.probe_panel.fix_waits) {
        if (!search.running) state.probe_panel.searched.reset();  // an earlier search was closed or cancelled
        return state.log.add(LogKind::Info, "The fix is made once a tried change is one");
    }
    if (fix) return apply_trial(state, *fix);
    state.log.add(LogKind::Info,
                  !state.probe_pixel
                      ? with_key("No fix to apply: click a wrong pixel first, or go to one", Command::NextWrongPixels)
                  : wrong ? "No fix to apply: no tried change puts this pixel right and makes nothing worse"
                          : "No fix to apply: this pixel is right");
}

void apply_waiting_fix(EditorState& state, const EditorFrame& frame) {
    if (!state.probe_panel.fix_waits) return;
    const bool searched = !frame.pixel_fixes.running && frame.pixel_fixes.table && frame.pixel_fixes.current &&
                          frame.pixel_fixes.pixel == state.probe_pixel;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) || !frame.result)  // the click probes another pixel
        state.probe_panel.fix_waits = false;
    else if (!verdict_follows(state, frame) && (searched || found_fix(frame.pixel_fixes, state.probe_pixel) ||
                                                std::ranges::none_of(frame.diagnoses, &PixelDiagnosis::wants_fix)))
        apply_fix(state, frame);
}

void request_pixel_fix(EditorState& state, const EditorFrame& frame, FixRequests& requests) {
    const bool wanted = state.shows(Page::Pixel) || improves_pixel(state) || state.probe_panel.fix_waits;
    if (!wanted || !state.probe_pixel || !frame.result || !frame.scene || verdict_follows(state, frame)) return;
    const ProbePanel::Searched now{*state.probe_pixel,
                                   {frame.result->colour.width, frame.result->colour.height},
                                   frame.scene->id,
                                   measured_settings(state.settings)};
    if (state.probe_panel.searched == now) return;
    for (const PixelDiagnosis& d : frame.diagnoses) {
        if (d.light != shown_light(state.settings) || !d.wants_fix()) continue;
        state.probe_panel.searched = now;
        requests.find_fixes = FixRequest{state.probe_pixel, true};
    }
}

void toggle_pointed_quads(EditorState& state, const EditorFrame& frame) {
    std::optional<TexelPlace> place = frame.result ? hovered_place(state, frame) : std::nullopt;
    if (frame.result && !place) place = probed_place(state, frame);
    if (!place)
        return state.log.add(LogKind::Info,
                             "No stored-depth quads to show: point at a surface whose shadow the map decides");
    toggle_quads(state.settings, *place);
    state.log.add(LogKind::Info, shows_quads_at(state.settings, *place)
                                     ? "Stored-depth quads are shown about this place, each as large as its texel: "
                                       "come closer (wheel) where they are too small"
                                     : "Stored-depth quads are off");
}

bool shows_quads_at(const Settings& settings, const TexelPlace& place) {
    const ViewSettings& v = settings.view;
    return v.slabs != Slabs::None && v.light == place.light && v.face == place.face && v.slabs_u == place.u &&
           v.slabs_v == place.v;
}

void toggle_quads(Settings& settings, const TexelPlace& place) {
    ViewSettings& v = settings.view;
    if (shows_quads_at(settings, place)) {
        v.slabs = Slabs::None;
        return;
    }
    if (v.slabs == Slabs::None) v.slabs = Slabs::Both;
    v.light = place.light;
    v.face = place.face;
    v.slabs_u = place.u;
    v.slabs_v = place.v;
}

}  // namespace si
