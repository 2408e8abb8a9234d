#include "ui/panels/page_tabs.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"

namespace si {
namespace {

std::ptrdiff_t page_count(Tab which) {
    return std::ranges::count(kPageTable, which, &PageRow::tab);
}

}  // namespace

DrawnTab draw_tab(WindowState& window, Tab which, const std::string& label) {
    const bool awaited = window.open_page && tab_of(*window.open_page) == which;
    if (awaited) window.pages[std::size_t(index_of(which))] = *window.open_page;
    DrawnTab drawn;
    drawn.front =
        ImGui::BeginTabItem(label.c_str(), nullptr, awaited ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None);
    drawn.pressed = ImGui::IsItemActivated();
    if (drawn.front) ImGui::EndTabItem();
    return drawn;
}

bool is_page_awaited(const WindowState& window, bool in_inspector) {
    return window.open_page && is_in_inspector(tab_of(*window.open_page)) == in_inspector;
}

bool double_click_on_tabs() {
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    const ImGuiTabBar* bar = g.CurrentTabBar;
    // Buttons beside the tabs, and those that scroll and list them, are pressed twice without a further meaning.
    const ImGuiID hovered = g.HoveredIdPreviousFrame;
    if (hovered != 0 && std::ranges::find(bar->Tabs, hovered, &ImGuiTabItem::ID) == bar->Tabs.end()) return false;
    return ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) &&
           ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&  // the active item is the tab
           bar->BarRect.Contains(ImGui::GetIO().MousePos);
}

float page_buttons_width(Tab which) {
    if (page_count(which) < 2) return 0;
    float width = 0;
    for (const PageRow& row : kPageTable)
        if (row.tab == which) width += button_width(row.label) + ImGui::GetStyle().ItemInnerSpacing.x;
    return width - ImGui::GetStyle().ItemInnerSpacing.x;
}

void draw_page_buttons(WindowState& window, Tab which) {
    Page& shown = window.pages[std::size_t(index_of(which))];
    bool first = true;
    for (const PageRow& row : kPageTable) {
        if (row.tab != which) continue;
        if (!first) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        first = false;
        if (toggle_button(row.label, shown == row.page)) shown = row.page;
    }
}

}  // namespace si
