#include "ui/state/editor_ui.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "renderer/advise/trial.h"
#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"
#include "ui/panels/log_panel.h"
#include "ui/scene_view/camera_steering.h"
#include "ui/state/panels.h"
#include "ui/state/playback.h"
#include "ui/state/quick_changes.h"
#include "ui/state/selection.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kPictures = 10;             ///< smallest height of the pictures above the open strip, ems
constexpr float kFrequentSettings = 24.6f;  ///< height of the inspector that fits the frequently used settings, ems
constexpr float kMapTexts = 6.2f;           ///< height of the texts above and below the map, ems
constexpr float kMapPlots = 6.5f;           ///< height of the plots under the map, ems
constexpr float kWidthLeftOfSettings = 40;  ///< width that an inspector wider than a third leaves, ems
constexpr float kSplitter = 5;              ///< at scale 1, pixels

/// Requests a screenshot of a part of this frame.
void take_shot(EditorState& state, EditorRequests& requests, Shot of) {
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const ScreenRect rect = of == Shot::Scene     ? state.shots.scene_rect
                            : of == Shot::Map     ? state.shots.map_rect
                            : of == Shot::Drawing ? state.shots.drawing_rect
                                                  : ScreenRect{{0, 0}, {all.x, all.y}};
    if (rect.size.x >= 1 && rect.size.y >= 1)
        requests.shot = ShotRequest{of, rect};
    else
        state.log.add(LogKind::Info,
                      of == Shot::Map ? with_key("The map is hidden", Command::NextMapPlace) + ": no screenshot of it"
                      : of == Shot::Drawing ? std::string("No drawing is shown: click a pixel, and open the tab Pixel")
                                            : std::string("The scene is hidden: no screenshot of it"));
}

/// Draws a splitter. A drag sets a member of the layout to `dragged(pixels)`; a double click resets the member.
void splitter(const char* id, bool vertical, ImVec2 size, EditorLayout& layout, float EditorLayout::*member,
              const auto& dragged) {
    ImGui::InvisibleButton(id, size);
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot) ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    const float thin = hot ? 1.0f : 0.5f;
    const ImVec2 c(0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y));
    const ImU32 colour = hot ? theme::muted() : theme::line();
    if (vertical)
        ImGui::GetWindowDrawList()->AddRectFilled({c.x - thin, lo.y}, {c.x + thin, hi.y}, colour);
    else
        ImGui::GetWindowDrawList()->AddRectFilled({lo.x, c.y - thin}, {hi.x, c.y + thin}, colour);
    const float by = vertical ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
    if (hot && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        layout.*member = EditorLayout{}.*member;
    else if (!ImGui::IsItemActive())
        plain_tooltip("Drag; double-click: as at first");
    else if (by != 0)
        layout.*member = dragged(by);
}

/// Gives the keyboard to the window that is being drawn, and marks its first widget.
void focus_this_window() {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    ImGui::FocusWindow(g.CurrentWindow);
    ImGui::NavInitWindow(g.CurrentWindow, true);
    g.NavDisableHighlight = false;
    g.NavDisableMouseHover = true;
}

/// Draws a part of the window with the usual gaps inside; the window itself has none between its parts.
void child(KeyboardState& keyboard, WindowPart part, ImVec2 size, const auto& draw) {
    constexpr const char* kIds[kWindowParts] = {"top", "scene", "map", "time", "bottom", "inspector", "status"};
    const char* const id = kIds[index_of(part)];
    const float em = ImGui::GetFontSize();
    ImGui::BeginChild(
        id, size, false,
        ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    if (keyboard.wanted == part) {
        keyboard.wanted.reset();
        keyboard.focused = part;
        focus_this_window();
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(em * 0.53f, em * 0.33f));
    draw();
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

/// Draws one of the window's panels.
void draw_panel(EditorState& state, const EditorFrame& frame, EditorRequests& requests, Panel which, ImVec2 size) {
    constexpr WindowPart kParts[] = {WindowPart::Scene, WindowPart::Map, WindowPart::Strip, WindowPart::Inspector};
    constexpr decltype(&draw_strip) kDraws[] = {draw_viewport, draw_map_viewer, draw_strip, draw_inspector};
    child(state.keyboard, kParts[int(which)], size, [&] { kDraws[int(which)](state, frame, requests); });
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_RectOnly)) state.window.hovered_panel = which;
}

/// Draws the panel that fills the window.
void one_panel(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    ImVec2 rest = ImGui::GetContentRegionAvail();
    rest.y -= status_bar_height();
    state.viewport.covered = 0;
    draw_panel(state, frame, requests, *state.window.maximised, rest);
}

/// Draws the scene and, if placed there, the map next to it or in it.
void pictures_row(EditorState& state, const EditorFrame& frame, EditorRequests& requests, ImVec2 size, float bar) {
    EditorLayout& layout = state.layout;
    const float em = ImGui::GetFontSize(), covered = state.viewport.covered;
    if (layout.map_place == MapSpot::NextToScene) {
        const float map = std::clamp(size.x * layout.map_share, em * 8, std::max(em * 8, size.x - em * 12));
        draw_panel(state, frame, requests, Panel::Scene, {size.x - map - bar, size.y});
        ImGui::SameLine();
        splitter("map splitter", true, {bar, size.y}, layout, &EditorLayout::map_share,
                 [&](float by) { return std::clamp((map - by) / size.x, 0.1f, 0.85f); });
        ImGui::SameLine();
        draw_panel(state, frame, requests, Panel::Map, {map, size.y - covered});
        return;
    }
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    draw_panel(state, frame, requests, Panel::Scene, size);
    if (layout.map_place != MapSpot::Inset) return;
    const float side = std::min(layout.map_inset * em, 0.6f * std::min(size.x, size.y - covered));
    const ImVec2 after = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({corner.x + size.x - side - em, corner.y + size.y - covered - side - em});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::panel());
    draw_panel(state, frame, requests, Panel::Map, {side, side});
    ImGui::PopStyleColor();
    ImGui::SetCursorScreenPos(after);
}

/// Draws the inspector and, if placed there, the map above it.
void right_column(EditorState& state, const EditorFrame& frame, EditorRequests& requests, ImVec2 size, float bar) {
    EditorLayout& layout = state.layout;
    const float em = ImGui::GetFontSize();
    ImGui::BeginGroup();
    if (layout.map_place == MapSpot::AboveSettings) {
        // Before the first drag, the map leaves the settings enough room, and all room that a square cannot use.
        const bool as_given = layout.map_height == EditorLayout{}.map_height;
        const float square = size.x + em * (layout.map_plots ? kMapTexts + kMapPlots : kMapTexts);
        const float wanted = as_given ? std::min(size.y * layout.map_height, square) : size.y * layout.map_height;
        const float map =
            std::clamp(wanted, em * 8, std::max(em * 8, size.y - em * (as_given ? kFrequentSettings : 10)));
        draw_panel(state, frame, requests, Panel::Map, {size.x, map});
        splitter("map splitter", false, {size.x, bar}, layout, &EditorLayout::map_height,
                 [&](float by) { return std::clamp((map + by) / size.y, 0.1f, 0.9f); });
        size.y -= map + bar;
    }
    draw_panel(state, frame, requests, Panel::Inspector, size);
    ImGui::EndGroup();
}

/// Returns the largest width of the inspector: half of the window, a third of a narrow one.
float most_settings(float width) {
    return std::clamp(width - kWidthLeftOfSettings * ImGui::GetFontSize(), width / 3, width / 2);
}

void all_panels(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const float em = ImGui::GetFontSize(), bar = kSplitter * em / 15;
    const float top = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y;
    child(state.keyboard, WindowPart::Menus, {0, top}, [&] { draw_top_bar(state, frame, requests); });

    EditorLayout& layout = state.layout;
    ImVec2 rest = ImGui::GetContentRegionAvail();
    rest.y -= status_bar_height();
    const float settings =
        std::floor(std::clamp(layout.settings_width * em, em * 14, std::max(em * 14, most_settings(rest.x))));
    const float left = std::max(rest.x - settings - bar, em * 10);

    ImGui::BeginGroup();
    draw_notes(state, frame, requests, left);
    const float strips = std::max(0.0f, ImGui::GetCursorPosY() - top), time = time_bar_height(frame);
    // The picture keeps its size while the strip opens, closes or is dragged: the strip lies over its lower part.
    const float closed = closed_strip_height();
    const float pictures = std::max(rest.y - strips - closed - time, em * 6);
    const float most = std::max(em * 4, std::min(rest.y * 0.7f, rest.y - strips - bar - time - em * kPictures));
    const bool open = layout.strip_open;
    const float strip = open ? std::clamp(layout.bottom_height * em, em * 4, most) : closed;
    state.viewport.covered = open ? std::clamp(strip + bar - closed, 0.0f, pictures) : 0;
    pictures_row(state, frame, requests, {left, pictures}, bar);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - state.viewport.covered);
    if (time > 0) child(state.keyboard, WindowPart::Time, {left, time}, [&] { draw_time_bar(state, frame); });
    if (open) {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + left, corner.y + bar}, theme::panel());
        splitter("bottom splitter", false, {left, bar}, layout, &EditorLayout::bottom_height,
                 [&](float by) { return std::max((strip - by) / em, 2.0f); });
    }
    draw_panel(state, frame, requests, Panel::Strip, {left, strip});
    ImGui::EndGroup();
    ImGui::SameLine();
    splitter("settings splitter", true, {bar, rest.y}, layout, &EditorLayout::settings_width,
             [&](float by) { return (settings - by) / em; });
    ImGui::SameLine();
    right_column(state, frame, requests, {settings, rest.y}, bar);
}

}  // namespace

bool text_is_typed() {
    return ImGui::GetIO().WantTextInput || ImGui::GetCurrentContext()->WantTextInputNextFrame == 1;
}

void toggle_maximised(EditorState& state, Panel panel) {
    if (state.window.maximised == panel)
        state.window.maximised.reset();
    else
        state.window.maximised = panel;
}

EditorRequests draw_editor(EditorState& state, const EditorFrame& frame) {
    EditorRequests requests;
    const std::optional<Shot> shot = std::exchange(state.shots.next, {});
    state.shots.scene_rect = state.shots.map_rect = state.shots.drawing_rect = {};
    state.viewport.dragging = false;
    theme::set_light(state.layout.light_theme);
    const EngineWording engine = engine_wording(state.engine_panel, state.settings, frame.result);
    const SettingFacts setting_facts{.driver = frame.driver,
                                     .scene = frame.scene,
                                     .result = frame.result,
                                     .files = &state.files.dialog,
                                     .engine = engine.profile ? &engine : nullptr,
                                     .searched = state.settings_panel.search};
    use_setting_facts(&setting_facts);
    const struct FactsEnd {
        ~FactsEnd() { use_setting_facts(nullptr); }
    } facts_end;  // the facts end with this function, also when a panel throws
    if (frame.result && frame.scene) keep_times(state.times, *frame.result, frame.scene->name, ImGui::GetTime());
    advance_animation(state, frame, double(ImGui::GetIO().DeltaTime));
    // In slow frames, a click in this frame may focus a text field that the typed letters belong to.
    const bool keys_wait = ImGui::IsMouseClicked(ImGuiMouseButton_Left);
    if (!keys_wait) dispatch_shortcuts(state, frame, requests);
    state.viewport.lights_listed = std::exchange(state.lights.listed, false);
    apply_waiting_fix(state, frame);
    request_pixel_fix(state, frame, requests);
    const bool waits = follow_artefact_tour(state, frame);

    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(io.DisplaySize);
    // A window below its smallest size, which some window managers make, is scrolled.
    const ImVec2 least(kMinWindowWidth / 15 * ImGui::GetFontSize(), kMinWindowHeight / 15 * ImGui::GetFontSize());
    const bool cramped = io.DisplaySize.x < least.x || io.DisplaySize.y < least.y;
    if (cramped)
        ImGui::SetNextWindowContentSize({std::max(io.DisplaySize.x, least.x), std::max(io.DisplaySize.y, least.y)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::Begin("editor", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
                     (cramped ? ImGuiWindowFlags_HorizontalScrollbar : ImGuiWindowFlags_NoScrollbar));
    ImGui::PopStyleVar();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    if (state.window.maximised)
        one_panel(state, frame, requests);
    else
        all_panels(state, frame, requests);
    child(state.keyboard, WindowPart::Status, {0, status_bar_height()}, [&] { draw_status_bar(state, frame); });
    if (KeyboardState& keyboard = state.keyboard; keyboard.wanted) {
        keyboard.wanted = part_after(*keyboard.wanted, keyboard.step);
        requests.redraw = true;
    }
    ImGui::PopStyleVar();
    draw_welcome(state, frame, requests);
    draw_shortcuts(state.window.show_shortcuts);
    draw_file_dialog(state, frame, requests);
    draw_replace_dialog(state, requests);
    draw_import_dialog(state.import_dialog, frame.importing, state.scene_name, requests);
    draw_convert_dialog(state.convert, frame.conversion, requests);
    draw_report_dialog(state.report, frame.report, frame, state.pinned.has_value(), state.probe_pixel, requests);
    ImGui::End();

    if (keys_wait) {
        dispatch_shortcuts(state, frame, requests);
        requests.redraw = true;
    }
    if (!state.shows(Page::Objects) || (state.window.maximised && *state.window.maximised != Panel::Inspector))
        state.objects.hovered.clear();  // the list is hidden, so that no row is hovered
    const bool strip_drawn = !state.window.maximised || *state.window.maximised == Panel::Strip;
    requests.want_timing = strip_drawn && state.strip_page == Page::Effects;
    requests.want_error |= strip_drawn && state.strip_page == Page::Error;
    // The legend of the artefact overlay has pixel counts.
    requests.want_error |= any_pane_shows(state.settings.view, &Overlay::names_causes) || waits;
    assign_arrow_keys(state);
    assign_page_keys(state);
    state.window.had_popup = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);
    if (shot) take_shot(state, requests, *shot);
    requests.redraw |= state.shots.next.has_value();
    const bool turning_wheel = ImGui::GetTime() < state.viewport.wheel_until;
    if (requests.apply_fix) {
        apply_trial(state, *requests.apply_fix);
        hide_tried(state);
    }
    if (requests.show_fix) {
        Settings tried = state.settings;
        set_settings(tried, requests.show_fix->changes);
        show_tried(state, tried);
    }
    follow_tried(state);
    check_prediction(state, frame, requests);
    if (requests.hide_tried) hide_tried(state);
    if (requests.show_bias) {
        Settings tried = state.settings;
        tried.bias = *requests.show_bias;
        show_tried(state, tried);
    }
    const bool gesture = ImGui::IsAnyItemActive() || state.viewport.dragging || turning_wheel;
    state.history.set_place({state.scene_name, state.files.guide});
    state.history.record(state.settings, gesture || state.between_steps);
    // The cursor is not hidden for a click: moving it back would turn the camera.
    requests.hold_cursor = state.viewport.flight.on &&
                           (state.viewport.camera_flew || ImGui::IsMouseDragging(ImGuiMouseButton_Right, kClickPixels));
    requests.redraw |= state.playback.playing || turning_wheel || state.viewport.flight.moving;
    requests.at_rest = !gesture && !requests.redraw && !ImGui::IsAnyMouseDown() && io.MouseWheel == 0 &&
                       io.MouseDelta.x == 0 && io.MouseDelta.y == 0;
    return requests;
}

}  // namespace si
