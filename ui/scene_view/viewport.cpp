// Viewport: one or several scene pictures, mouse and keys over them, and marks drawn onto them.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "renderer/frame/pane_grid.h"
#include "renderer/inspect/probe.h"
#include "renderer/settings/overlays.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/scene_view/cascade_bar.h"
#include "ui/scene_view/picture_marks.h"
#include "ui/scene_view/picture_painter.h"
#include "ui/scene_view/scene_marks.h"
#include "ui/state/panels.h"
#include "ui/state/quick_changes.h"
#include "ui/state/selection.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/overlay_widget.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/toolbar.h"

namespace si {
namespace {

/// Returns true if a light's source is ray traced or a light map, and is not computed yet.
bool awaits_rays(const FrameResult& result) {
    const auto awaits = [](const auto& n) { return n.key != 0 && !n.met; };
    return std::any_of(result.traced.begin(), result.traced.end(), awaits) ||
           std::any_of(result.light_maps.begin(), result.light_maps.end(), awaits);
}

/// Gives several panes without any overlay different ones, so that they do not all show the same picture.
void fill_empty_panes(Settings& settings) {
    const auto pane_count = std::size_t(pane_grid(settings.view.panes, 0, 0, 0).count());
    for (std::size_t pane = 0; pane < pane_count; ++pane)
        if (overlay_of_pane(settings.view, pane) != 0) return;
    for (std::size_t row = 0; row < overlays().size(); ++row)
        if (const std::size_t pane = overlays()[row].first_pane; pane > 0 && pane < pane_count)
            overlay_of_pane(settings.view, pane) = int(row) + 1;
}

void header(EditorState& state, const EditorFrame& frame) {
    Settings& s = state.settings;
    const float em = ImGui::GetFontSize();
    Toolbar bar("scene tools");
    bar.title("Scene");
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        toggle_maximised(state, Panel::Scene);
    bar.item("Overlay", em * 9, [&s](float room) { overlay_widget(s, overlay_setting(0), room); });
    bar.item("Compare", em * 6.5f, [&state](float room) { comparison_view_widget(state, room); });
    bar.item("", em * 9, [&](float room) { comparison_other_widget(state, frame, room); });
    bar.item("Panes", em * 4, [&state, &s](float room) {
        const bool comparing = chosen_comparison(state) != ComparisonView::Off;
        ImGui::BeginDisabled(comparing);
        const Panes before = s.view.panes;
        setting_widget(s, "view.panes", room);
        if (s.view.panes != before) fill_empty_panes(s);
        ImGui::EndDisabled();
        if (comparing) wrapped_tooltip("Comparing shows one picture and the other side of it.");
    });
    bar.item("", button_width("Through light"), [&](float) {
        if (toggle_button("Through light", s.camera.source == CameraSource::Light)) toggle_light_camera(state);
        plain_tooltip(with_key("Look through the shown light", Command::ToggleLightCamera) + "\ncamera.source");
    });
    bar.item("", button_width("Freeze view"), [&](float) {
        if (toggle_button("Freeze view", state.frozen.has_value())) toggle_frozen_camera(state, frame);
        plain_tooltip(with_key("Keep this camera and fly about with another", Command::ToggleFrozenCamera) +
                      ": maps that follow a camera, cascades too, stay\n"
                      "made for it, its frustum stays drawn in the scene and in the map, and the texels counted are\n"
                      "those that it reads.");
    });
    bar.item("Lights", ImGui::GetFrameHeight(), [&s](float room) { setting_widget(s, "view.frustum", room); });
    bar.end();
}

/// Selects the object that a double click has probed; the background selects none.
void select_probed(EditorState& state, const EditorFrame& frame) {
    if (!state.viewport.select_probed || !frame.probe || ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
    if (!state.probe_pixel || glm::ivec2(frame.probe->x, frame.probe->y) != *state.probe_pixel) return;
    select_objects(state, std::span(&frame.probe->object, frame.probe->hit ? 1 : 0));
    state.viewport.select_probed = false;
}

/// Draws the reason in place of a missing picture.
void no_picture(const EditorState& state, const EditorFrame& frame, ImVec2 origin, ImVec2 size) {
    const float em = ImGui::GetFontSize();
    if (frame.drawing) {
        const float wide = std::min(size.x - 2 * em, em * 34);
        ImGui::SetCursorScreenPos({origin.x + (size.x - wide) / 2, origin.y + em * 2});
        std::string text = fmt::format("Drawing {} for the first time", scene_label(state.scene_name));
        text += frame.drawing->pass.empty() ? " …" : ": " + frame.drawing->pass;
        progress_bar(frame.drawing->progress, text, wide);
        return;
    }
    const std::string text = frame.problem.empty() && !frame.loading ? "No picture yet" : std::string(frame.problem);
    ImGui::SetCursorScreenPos({origin.x + em, origin.y + em});
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x - 2 * em);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
}

/// Placement of the panes on the screen.
struct Panorama {
    PaneGrid grid;  ///< rectangles in pixels of the pictures
    ImVec2 origin;
    float pixels;  ///< pixels of a picture per unit of the screen
    float end;     ///< y of the screen where the open strip begins to cover the pictures
    ImVec2 lo(int pane) const {
        const glm::vec2 corner = glm::vec2(grid.corner(pane)) / pixels;
        return {origin.x + corner.x, origin.y + corner.y};
    }
    ImVec2 size() const { return {float(grid.width) / pixels, float(grid.height) / pixels}; }
    /// Returns the lower end of a pane that is not covered.
    float bottom(int pane) const {
        const float top = lo(pane).y;
        return std::max(std::min(top + size().y, end), std::min(top + size().y, top + ImGui::GetFontSize() * 6));
    }
    /// Returns the pixel of `pane` at a point of the screen; it may lie outside the pane.
    glm::ivec2 pixel(int pane, ImVec2 at) const {
        const ImVec2 corner = lo(pane);
        return {int(std::floor((at.x - corner.x) * pixels)), int(std::floor((at.y - corner.y) * pixels))};
    }
    bool holds(glm::ivec2 pixel) const {
        return pixel.x >= 0 && pixel.y >= 0 && pixel.x < grid.width && pixel.y < grid.height;
    }
};

/// Handles mouse and keys over the panes. The pane in which a press began keeps the mouse until the release.
void steer(EditorState& state, const EditorFrame& frame, EditorRequests& requests, const Panorama& panes) {
    const bool hovered = ImGui::IsItemHovered();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (!ImGui::IsItemActive() || ImGui::IsItemActivated())
        for (int i = 0; i < panes.grid.count(); ++i)
            if (panes.holds(panes.pixel(i, mouse))) state.active_pane = i;
    state.active_pane = std::clamp(state.active_pane, 0, panes.grid.count() - 1);
    const bool released = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    const ImVec2 lo = panes.lo(state.active_pane), size = panes.size();
    const PictureView view{frame.result->camera, {lo.x, lo.y}, {size.x, size.y}, ImGui::GetFontSize() / 15.0};
    state.viewport.view = view;
    if (ImGui::IsItemActivated()) state.viewport.press_moved = state.viewport.press_taken = false;
    if (steer_swipe(state, view)) {
        state.viewport.press_taken = state.viewport.press_moved = true;
        return;
    }
    steer_gnomon(state, frame, view);
    steer_lights(state, frame, view);
    const bool taken = state.viewport.press_taken;
    if (!taken) steer_camera(state, frame, view);
    if (!ImGui::IsItemActive()) state.viewport.press_taken = false;
    const glm::ivec2 pixel = panes.pixel(state.active_pane, mouse);
    if (!hovered || !panes.holds(pixel)) return;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !taken) state.viewport.select_probed = true;
    if (released && !state.viewport.press_moved && !taken) {
        state.probe_pixel = pixel;
        state.keyboard.probe_has_arrows = true;
        show_pixel(state);
    }
    state.viewport.hovered_pixel = pixel;
    requests.want_links = requests.want_overlay_values = !state.viewport.dragging;
}

/// Moves the probed pixel to the present place of its surface point. @param wanted size of the picture, pixels
void follow_probe(EditorState& state, const EditorFrame& frame, glm::ivec2 wanted) {
    const bool settled = state.viewport.wanted_size == wanted;
    state.viewport.wanted_size = wanted;
    if (state.probe_anchor &&
        (state.probe_anchor->pixel != state.probe_pixel || state.probe_anchor->scene != state.scene_name))
        state.probe_anchor.reset();
    // A pixel chosen in a picture of another size is clamped into this one.
    if (state.probe_pixel && !state.probe_anchor && settled)
        state.probe_pixel = glm::clamp(*state.probe_pixel, glm::ivec2(0), glm::max(wanted, 1) - 1);
    if (!state.probe_pixel || !frame.probe) return;
    const Probe& probe = *frame.probe;
    const glm::ivec2 at(probe.x, probe.y);
    if (state.probe_anchor) {
        if (anchored_pixel(*state.probe_anchor, probe.camera, probe.width, probe.height) == at)
            state.probe_pixel = state.probe_anchor->pixel = at;
    } else if (probe.hit && settled && at == *state.probe_pixel && wanted == glm::ivec2(probe.width, probe.height)) {
        state.probe_anchor = ProbeAnchor{probe.position_ws, probe.normal_ws, state.scene_name, at};
    }
}

/// Returns the pixel at the centre of the loupe; none: it is hidden.
std::optional<glm::ivec2> loupe_pixel(const EditorState& state, const EditorFrame& frame) {
    if (state.loupe == LoupeMode::Off) return {};
    if (state.loupe == LoupeMode::Mouse && state.viewport.hovered_pixel) return state.viewport.hovered_pixel;
    return frame.anchor_place == AnchorPlace::Outside ? std::nullopt : state.probe_pixel;
}

/// Returns the first pane with an overlay, whose legend has the sliders of all panes; below 0: no pane has one.
int overlaid_pane(const FrameResult& result) {
    const auto at = std::ranges::find_if(result.panes, [](const Pane& pane) { return pane.overlay > 0; });
    return at == result.panes.end() ? -1 : int(at - result.panes.begin());
}

bool names_views(const Pane& pane) {
    return pane.overlay > 0 && overlays()[std::size_t(pane.overlay - 1)].names_views;
}

void draw_pane(const EditorState& state, const EditorFrame& frame, const Panorama& panes, int index) {
    const FrameResult& result = *frame.result;
    // The compared picture is next to the picture; both get the same marks.
    const Pane& pane = result.panes[std::min(std::size_t(index), result.panes.size() - 1)];
    const ImVec2 lo = panes.lo(index), size = panes.size(), hi(lo.x + size.x, lo.y + size.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddImage(texture_id(pane.picture.texture), lo, hi, {0, 1}, {1, 0});  // stored bottom row first
    if (pane.lacks_reference && frame.traced_so_far.texture != 0)
        list.AddImage(texture_id(frame.traced_so_far.texture), lo, hi, {0, 1}, {1, 0});
    list.PushClipRect(lo, hi, true);
    draw_comparison(state, frame, {lo.x, lo.y}, {size.x, size.y}, index > 0);
    const PictureView view{result.camera, {lo.x, lo.y}, {size.x, size.y}, ImGui::GetFontSize() / 15.0};
    draw_scene_marks(PicturePainter(view, list), state, frame);
    if (frame.anchor_place != AnchorPlace::Outside) draw_probe_mark(state, result, lo, size);
    draw_readers(state, frame, lo, size);
    const bool widgets = index == overlaid_pane(result);
    const float bottom = panes.bottom(index) - (widgets ? legend_widgets_height(state.settings, pane, size) : 0);
    if (pane.overlay > 0 && overlays()[std::size_t(pane.overlay - 1)].names_causes)
        draw_artefact_legend(frame.error, lo.x, bottom, size.x);
    else
        draw_legend(pane, shown_fitted_light(state.settings, result), result.map_size, lo.x, bottom, size);
    // A picture without marks is bare.
    const bool marked = state.settings.view.frustum && pane.overlay == 0;
    if (marked && result.contacts_darkened && size.x > ImGui::GetFontSize() * 30)
        draw_text_on_picture({lo.x + ImGui::GetFontSize(), hi.y - ImGui::GetFontSize() * 1.6f},
                             "Dark creases are a drawing style, not a shadow", theme::kOnPicture);
    if (state.viewport.hovered_pixel && index == state.active_pane) {
        // The caption names the pane's overlay, or the side of a comparison.
        const bool named = panes.grid.count() > 1 || state.comparison.view != ComparisonView::Off;
        const float below = named ? ImGui::GetFrameHeight() * 1.3f : 0;
        draw_hover_readout(frame, pane, shown_fitted_light(state.settings, result), {lo.x, lo.y + below},
                           *state.viewport.hovered_pixel);
    }
    if (index == state.active_pane) draw_loupe(state, frame, lo, size);
    list.PopClipRect();
}

}  // namespace

void draw_viewport(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    state.viewport.hovered_pixel.reset();
    state.loupe_pixel.reset();
    header(state, frame);
    const float em = ImGui::GetFontSize();
    const ImVec2 origin = ImGui::GetCursorScreenPos(), available = ImGui::GetContentRegionAvail();
    const ImVec2 size(std::floor(std::max(available.x, 16.0f)), std::floor(std::max(available.y, 16.0f)));
    const float pixels = ImGui::GetIO().DisplayFramebufferScale.x;
    const ComparisonView picture_comparison = state.comparison.view;
    const Panes shown_panes = picture_comparison == ComparisonView::Off          ? state.settings.view.panes
                              : picture_comparison == ComparisonView::SideBySide ? Panes::Two
                                                                                 : Panes::One;
    const Panorama panes{pane_grid(shown_panes, int(size.x * pixels), int(size.y * pixels), int(em * pixels * 0.2f)),
                         origin, pixels, origin.y + size.y - state.viewport.covered};
    requests.scene_width = panes.grid.width;
    requests.scene_height = panes.grid.height;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(origin, {origin.x + size.x, origin.y + size.y}, theme::well());
    state.shots.scene_rect = {{origin.x, origin.y}, {size.x, size.y}};
    // After a change of view.panes the pictures follow in the next frame.
    const int pictures = picture_comparison == ComparisonView::Off ? panes.grid.count() : 1;
    if (!frame.result || frame.result->colour.texture == 0 || int(frame.result->panes.size()) != pictures) {
        no_picture(state, frame, origin, size);
        draw_loading(frame, requests, origin.x, origin.y, size.x);
        draw_import_progress(frame.importing, origin.x, origin.y, size.x, requests);
        return;
    }
    ImGui::InvisibleButton(
        "scene picture", size,
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::SetItemAllowOverlap();
    // The arrow keys belong to the picture or panel that was clicked last.
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) state.keyboard.probe_has_arrows = ImGui::IsItemHovered();
    follow_probe(state, frame, {panes.grid.width, panes.grid.height});
    steer(state, frame, requests, panes);
    if (state.viewport.view) open_scene_menu(state, frame, *state.viewport.view);
    draw_scene_menu(state, frame);
    state.loupe_pixel = loupe_pixel(state, frame);
    select_probed(state, frame);
    for (int i = 0; i < panes.grid.count(); ++i) draw_pane(state, frame, panes, i);
    if (pictures > 1)
        for (int i = 0; i < panes.grid.count(); ++i) {
            const ImVec2 lo = panes.lo(i);
            ImGui::SetCursorScreenPos({lo.x + em * 0.4f, lo.y + em * 0.3f});
            ImGui::PushID("in the picture");
            overlay_widget(state.settings, overlay_setting(i), std::min(em * 11, panes.size().x - em));
            ImGui::PopID();
        }
    if (const int i = overlaid_pane(*frame.result); i >= 0)
        draw_legend_widgets(state.settings, frame.result->panes[std::size_t(i)], panes.lo(i).x, panes.bottom(i),
                            panes.size());
    if (const int i = overlaid_pane(*frame.result); i >= 0 && names_views(frame.result->panes[std::size_t(i)]))
        draw_cascade_bar(state.settings, frame.drawn, *frame.result, {panes.lo(i).x, panes.lo(i).y},
                         {panes.size().x, panes.bottom(i) - panes.lo(i).y},
                         legend_widgets_width(state.settings, frame.result->panes[std::size_t(i)]));
    if (!frame.shader_log.empty())
        draw_text_on_picture({origin.x + em * 0.8f, origin.y + em * 2.2f},
                             "A shader does not compile; the last good one is in use (see Log)");
    for (int i = 0; i < pictures; ++i)
        if (frame.result->panes[std::size_t(i)].lacks_reference || (i == 0 && awaits_rays(*frame.result))) {
            ImGui::PushID(i);
            draw_tracing(frame, requests, panes.lo(i).x, panes.bottom(i), panes.size().x);
            ImGui::PopID();
        }
    draw_loading(frame, requests, origin.x, origin.y, size.x);
    draw_import_progress(frame.importing, origin.x, origin.y, size.x, requests);
}

}  // namespace si
