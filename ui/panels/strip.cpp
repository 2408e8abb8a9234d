// The strip below the pictures: plots and tables, each in a tab. Its tabs stay at the lower edge, and its pages open
// above them, over the lower part of the pictures.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>

#include "renderer/base/index_of.h"
#include "ui/panels/log_panel.h"
#include "ui/panels/page_tabs.h"
#include "ui/state/panels.h"
#include "ui/state/selection.h"
#include "ui/state/shortcuts.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kFindingTexels = 24;  ///< width of the map viewer about a texel of a finding, texels
constexpr float kAllStripTabs = 24;   ///< width that fits all tabs, ems
constexpr const char* kAdvice = "Advice…";

void numbers_page(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    draw_health(state.settings, state.map.marked_texel, frame.result, frame, requests);
    if (requests.probe_pixel) state.probe_pixel = requests.probe_pixel;
    if (const auto& marked = requests.show_texel) {
        state.map.marked_texel = marked;
        const glm::vec2 sides(glm::max(frame.result->map_size.sides() >> marked->level, glm::ivec2(1)));
        state.map.window = {.zoom = std::max(1.0f, std::max(sides.x, sides.y) / kFindingTexels),
                            .centre = (glm::vec2(marked->texel) + 0.5f) / sides};
    }
}

void imported_page(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const FittedLight* const light = frame.result ? shown_fitted_light(state.settings, *frame.result) : nullptr;
    const auto index = std::size_t(std::max(state.settings.view.light, 0));
    const ImportedMaps* const maps =
        frame.result && index < frame.result->imported.size() ? frame.result->imported[index].get() : nullptr;
    draw_imported(state.imported_picture, state.imported_left_out, state.settings, light,
                  engine_bias(maps, state.settings), state.selection.first, frame, requests);
    if (requests.select_object) select_objects(state, std::array{*requests.select_object});
}

void light_path_page(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    draw_light_strip(state.light_strip, state.settings, frame, requests);
    if (requests.save_worst)
        open_file_dialog(state.files.dialog, FileDialog::Job::SavePreset, state.files.preset_path,
                         "The step with the largest error along a path of the light");
}

void draw_strip_page(EditorState& state, const EditorFrame& frame, EditorRequests& requests, Page page) {
    switch (page) {
        case Page::Frontier:
            return draw_frontier(state.sweep, state.settings, frame.sweep, requests);
        case Page::LightPath:
            return light_path_page(state, frame, requests);
        case Page::Effects:
            return draw_effects(state.effects, state.times, frame.result, frame.driver, frame, requests);
        case Page::Compare:
            return draw_compare(state.compare, state.settings, state.pinned, state.scene_name, frame.comparison, frame,
                                requests);
        case Page::Imported:
            return imported_page(state, frame, requests);
        case Page::Lab:
            return draw_lab(state.lab, state.settings, frame.scene, frame.result, frame, requests);
        case Page::Numbers:
            return numbers_page(state, frame, requests);
        case Page::Log:
            return draw_log(state.log, frame.shader_log);
        default:
            return draw_error(state, frame, requests);
    }
}

/// Draws a tab of the strip. A press on the tab in front closes an open strip; any other press opens it.
void strip_tab(EditorState& state, Tab which, bool alone) {
    WindowState& window = state.window;
    const bool awaited = is_page_awaited(window, false);
    const bool mine = awaited && tab_of(*window.open_page) == which;
    const int errors = which == Tab::Log ? state.log.unseen_errors() : 0;
    const std::string label = which != Tab::Log ? kTabLabels[index_of(which)]
                              : errors > 0      ? fmt::format("Log ({})###Log", errors)
                                                : std::string("Log###Log");
    if (errors > 0) ImGui::PushStyleColor(ImGuiCol_Text, theme::error());
    // No tab of a closed strip looks selected.
    const bool shut = !alone && !state.layout.strip_open;
    if (shut) ImGui::PushStyleColor(ImGuiCol_TabActive, ImGui::GetStyleColorVec4(ImGuiCol_Tab));
    const DrawnTab drawn = draw_tab(window, which, label);
    if (shut) ImGui::PopStyleColor();
    if (errors > 0) ImGui::PopStyleColor();
    if (drawn.pressed && !alone) state.layout.strip_open = !(drawn.front && state.layout.strip_open);
    if (!drawn.front || (awaited && !mine)) return;
    window.strip_tab = which;
    if (mine) window.open_page.reset();
}

/// Draws the buttons of the front tab's pages and the button that closes the strip, right of the tabs.
/// @param free width right of the tabs, pixels
/// @returns false if the pages' buttons have no room there
bool buttons_beside_tabs(EditorState& state, ImVec2 row, float width, float free, bool alone) {
    const float em = ImGui::GetFontSize(), gap = ImGui::GetStyle().ItemInnerSpacing.x;
    float right = row.x + width;
    if (!alone) {
        right -= button_width("×");
        ImGui::SetCursorScreenPos({right, row.y});
        if (ImGui::Button("×")) {
            state.layout.strip_open = false;
            ImGui::GetIO().MouseClickedTime[ImGuiMouseButton_Left] = -1;  // no double click on what comes to light
        }
        plain_tooltip(with_key("Closes the strip", Command::ToggleStrip));
        right -= em;
    }
    const bool cost = state.window.strip_tab == Tab::Cost;
    const float pages = page_buttons_width(state.window.strip_tab) + (cost ? gap + button_width(kAdvice) : 0);
    if (pages <= 0) return true;
    if (pages + em * (alone ? 1 : 4) > free) return false;
    ImGui::SetCursorScreenPos({right - pages, row.y});
    draw_page_buttons(state.window, state.window.strip_tab);
    if (cost) {
        ImGui::SameLine(0, gap);
        if (ImGui::Button(kAdvice)) open_improve(state, ImproveMode::Cheaper);
        plain_tooltip("Measures each change that may save time: tab Improve");
    }
    return true;
}

}  // namespace

float closed_strip_height() {
    return ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y;
}

void draw_strip(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    WindowState& window = state.window;
    const bool alone = window.maximised == Panel::Strip;
    const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    if (is_page_awaited(window, false)) state.layout.strip_open = true;
    const ImVec2 row(corner.x, corner.y + room.y - ImGui::GetFrameHeight());
    ImGui::SetCursorScreenPos(row);
    // Tabs without room are scrolled and listed, not squeezed.
    ImGuiTabBarFlags flags = ImGuiTabBarFlags_FittingPolicyScroll;
    if (room.x < ImGui::GetFontSize() * kAllStripTabs) flags |= ImGuiTabBarFlags_TabListPopupButton;
    if (!ImGui::BeginTabBar("bottom", flags)) return;
    for (int i = index_of(Tab::Error); i < kTabs; ++i) strip_tab(state, Tab(i), alone);
    const float tabs = ImGui::GetCurrentContext()->CurrentTabBar->WidthAllTabs;
    if (double_click_on_tabs()) {
        state.layout.strip_open = true;
        toggle_maximised(state, Panel::Strip);
    }
    ImGui::EndTabBar();
    requests.redraw |= is_page_awaited(window, false);
    state.strip_page.reset();
    if (!alone && !state.layout.strip_open) return;
    const bool beside = buttons_beside_tabs(state, row, room.x, room.x - tabs, alone);
    state.strip_page = window.pages[std::size_t(index_of(window.strip_tab))];
    const float height = room.y - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemSpacing.y;
    requests.redraw |= height < ImGui::GetFontSize();  // it opens with the next frame
    if (height < ImGui::GetFontSize()) return;
    ImGui::SetCursorScreenPos(corner);
    ImGui::BeginChild(kPageTable[index_of(*state.strip_page)].key, {room.x, height}, false,
                      ImGuiWindowFlags_NavFlattened);
    if (!beside) draw_page_buttons(window, window.strip_tab);
    draw_strip_page(state, frame, requests, *state.strip_page);
    ImGui::EndChild();
}

}  // namespace si
