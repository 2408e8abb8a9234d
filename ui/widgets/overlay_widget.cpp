#include "ui/widgets/overlay_widget.h"

#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "renderer/settings/overlays.h"
#include "renderer/settings/param.h"
#include "ui/widgets/combo.h"
#include "ui/widgets/setting_widgets.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/tooltip.h"

namespace si {
namespace {

constexpr const char* kGroups[] = {"What is wrong", "Bias", "Resolution", "Depth", "Debug"};

/// A line of the list. @param number of the overlay's row + 1; 0: none
bool line(const char* label, std::string_view help, int number, int chosen) {
    ImGui::PushID(number);
    const bool picked = ImGui::Selectable(label, number == chosen) && number != chosen;
    if (number == chosen) ImGui::SetItemDefaultFocus();
    if (!help.empty()) wrapped_tooltip(std::string(help));
    if (number <= 9) {  // its key
        const std::string digit = fmt::format("{}", number);
        const ImVec2 hi = ImGui::GetItemRectMax();
        const float top = ImGui::GetItemRectMin().y;
        ImGui::GetWindowDrawList()->AddText({hi.x - ImGui::GetFontSize(), top}, theme::muted(), digit.c_str());
    }
    ImGui::PopID();
    return picked;
}

}  // namespace

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
        for (std::size_t group = 0; group < std::size(kGroups); ++group) {
            ImGui::Dummy({0, ImGui::GetFontSize() * 0.15f});
            ImGui::TextDisabled("%s", kGroups[group]);
            for (std::size_t i = 0; i < rows.size(); ++i)
                if (rows[i].group == OverlayGroup(group) &&
                    line(std::string(rows[i].label).c_str(), rows[i].help, int(i) + 1, chosen))
                    wanted = int(i) + 1;
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
