#include "ui/widgets/overlay_widget.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

constexpr const char* kGroups[] = {"What is wrong", "Bias", "Resolution", "Depth", "Debug"};

constexpr int kDigits = 9;     ///< digits that show an overlay: 1 to 9
constexpr int kModifiers = 4;  ///< ways to hold Shift and Alt

constexpr std::string_view kPanes[] = {"view.overlay", "view.overlay_2", "view.overlay_3", "view.overlay_4"};

constexpr float kLabel = 13.5f, kKey = 3.6f;  ///< widths in a line, ems

/// Draws a line of the list. @param number the overlay's row + 1; 0: none
bool line(const char* label, std::string_view help, int number, int chosen) {
    const float em = ImGui::GetFontSize();
    ImGui::PushID(number);
    const bool picked = ImGui::Selectable(label, number == chosen, 0, {em * (kLabel + kKey), 0}) && number != chosen;
    if (number == chosen) ImGui::SetItemDefaultFocus();
    if (!help.empty()) wrapped_tooltip(std::string(help));
    const std::string key = overlay_key(number);
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddText(
        {hi.x - ImGui::CalcTextSize(key.c_str()).x - em * 0.3f, lo.y + ImGui::GetStyle().ItemSpacing.y * 0.5f},
        theme::muted(), key.c_str());
    ImGui::PopID();
    return picked;
}

/// Draws a heading and the overlays below it. Returns the clicked overlay's row + 1; 0: none.
int group_lines(OverlayGroup group, int chosen) {
    ImGui::Dummy({0, ImGui::GetFontSize() * 0.15f});
    ImGui::TextDisabled("%s", kGroups[std::size_t(group)]);
    int picked = 0;
    const auto rows = overlays();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].group == group && line(std::string(rows[i].label).c_str(), rows[i].help, int(i) + 1, chosen))
            picked = int(i) + 1;
    return picked;
}

}  // namespace

int overlay_of_digit(int digit, const HeldKeys& held) {
    if (digit < 1 || digit > kDigits || held.ctrl) return 0;
    const int number = digit + kDigits * (int(held.shift) + 2 * int(held.alt));
    return std::size_t(number) <= overlays().size() ? number : 0;
}

std::string overlay_key(int number) {
    if (number <= 0) return "0";
    const int row = (number - 1) / kDigits;
    if (row >= kModifiers) return {};
    return fmt::format("{}{}{}", row & 1 ? "Shift+" : "", row & 2 ? "Alt+" : "", (number - 1) % kDigits + 1);
}

std::string_view overlay_setting(int pane) {
    return kPanes[std::clamp(pane, 0, int(std::size(kPanes)) - 1)];
}

bool overlay_widget(Settings& settings, std::string_view key, float width) {
    const SettingRef ref = *find_setting(key);
    const int chosen = std::get<int>(get_value(settings, ref));
    const auto rows = overlays();
    const bool known = chosen > 0 && std::size_t(chosen) <= rows.size();
    const std::string shown = known ? std::string(rows[std::size_t(chosen - 1)].label) : "none";
    int wanted = chosen;
    ImGui::PushID(std::string(key).c_str());
    ImGui::SetNextItemWidth(width);
    if (begin_combo("##value", shown, ImGuiComboFlags_HeightLargest)) {
        if (line("none", "The shaded picture", 0, chosen)) wanted = 0;
        // Several columns fit into a small window without scrolling.
        for (const auto& column : {std::vector{OverlayGroup::Wrong, OverlayGroup::Bias},
                                   {OverlayGroup::Resolution, OverlayGroup::Depth, OverlayGroup::Debug}}) {
            if (column.front() != OverlayGroup::Wrong) ImGui::SameLine(0, ImGui::GetFontSize());
            ImGui::BeginGroup();
            for (const OverlayGroup group : column)
                if (const int picked = group_lines(group, chosen)) wanted = picked;
            ImGui::EndGroup();
        }
        ImGui::EndCombo();
    } else {
        setting_menu(settings, ref);
    }
    ImGui::PopID();
    if (wanted == chosen) return false;
    set_value(settings, ref, wanted);
    return true;
}

}  // namespace si
