// The inspector: settings, objects, lights, the probed pixel, and improvements, each in a tab.
#include <imgui.h>

#include "renderer/base/index_of.h"
#include "ui/panels/page_tabs.h"
#include "ui/state/panels.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr float kAllInspectorTabs = 22.5f;  ///< width that fits all tabs, ems
constexpr float kAllSmallTabs = 16.3f;      ///< width that fits all tabs in the small font, ems

void draw_inspector_page(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    switch (state.inspector_page) {
        case Page::Objects:
            return draw_objects(state, frame);
        case Page::Lights:
            return draw_lights_page(state, frame);
        case Page::Pixel:
            return draw_probe(state, frame);
        case Page::Improve:
            return draw_improve_panel(state, frame, requests);
        default:
            return draw_settings(state, frame, requests);
    }
}

/// Draws the tabs. @param listed they have no room, so that a button lists them
void draw_tabs(EditorState& state, EditorRequests& requests, bool listed) {
    WindowState& window = state.window;
    // Tabs without room are scrolled, not squeezed.
    ImGuiTabBarFlags flags = ImGuiTabBarFlags_FittingPolicyScroll;
    if (listed) flags |= ImGuiTabBarFlags_TabListPopupButton;
    if (!ImGui::BeginTabBar("inspector", flags)) return;
    for (int i = 0; i <= index_of(Tab::Improve); ++i) {
        const bool awaited = is_page_awaited(window, true);
        const bool mine = awaited && index_of(tab_of(*window.open_page)) == i;
        if (!draw_tab(window, Tab(i), kTabLabels[i]).front || (awaited && !mine)) continue;
        state.inspector_page = window.pages[std::size_t(i)];
        if (mine) window.open_page.reset();
    }
    requests.redraw |= is_page_awaited(window, true);
    if (double_click_on_tabs()) toggle_maximised(state, Panel::Inspector);
    ImGui::EndTabBar();
}

}  // namespace

void draw_inspector(EditorState& state, const EditorFrame& frame, EditorRequests& requests) {
    const float em = ImGui::GetFontSize(), room = ImGui::GetContentRegionAvail().x;
    const bool narrow = room < em * kAllInspectorTabs;
    const ImVec2 padding = ImGui::GetStyle().FramePadding, inner = ImGui::GetStyle().ItemInnerSpacing;
    if (narrow) {
        const float height = em + 2 * padding.y;
        ImGui::PushFont(theme::small());
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(em * 0.2f, (height - ImGui::GetFontSize()) / 2));
        ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, ImVec2(em * 0.13f, inner.y));
    }
    draw_tabs(state, requests, room < em * kAllSmallTabs);
    if (narrow) {
        ImGui::PopStyleVar(2);
        ImGui::PopFont();
    }
    ImGui::BeginChild(kPageTable[index_of(state.inspector_page)].key, {0, 0}, false, ImGuiWindowFlags_NavFlattened);
    draw_inspector_page(state, frame, requests);
    ImGui::EndChild();
}

}  // namespace si
