// Menu of guided presets and hard cases by topic, each with its description.
#include <imgui.h>

#include <algorithm>

#include "ui/panels/presets.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

/// Draws title and description as one item. Returns true if it was clicked.
bool entry(const PresetEntry& preset, bool current, float width) {
    const float em = ImGui::GetFontSize(), indent = em * 0.8f, wrap = width - 2 * indent;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 about = ImGui::CalcTextSize(preset.about.c_str(), nullptr, false, wrap);
    const float line = ImGui::GetTextLineHeight();
    ImGui::PushID(preset.key.c_str());
    const bool chosen =
        ImGui::Selectable("##entry", current, ImGuiSelectableFlags_None, {width, line + about.y + em * 0.4f});
    ImGui::PopID();
    if (current && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY(0.4f);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddText(theme::strong(), em, {at.x + indent, at.y + em * 0.1f}, theme::text(),
                 (preset.title.empty() ? preset.key : preset.title).c_str());
    draw.AddText(ImGui::GetFont(), em, {at.x + indent, at.y + line + em * 0.2f}, theme::muted(), preset.about.c_str(),
                 nullptr, wrap);
    return chosen;
}

}  // namespace

float presets_menu_width() {
    const float em = ImGui::GetFontSize();
    return std::min(em * 46, ImGui::GetIO().DisplaySize.x - 4 * em);
}

void draw_presets_menu(const char* id, std::span<const PresetEntry> presets, const std::string& open,
                       PresetRequests& requests) {
    const float em = ImGui::GetFontSize();
    const float height = std::min(em * 44, ImGui::GetIO().DisplaySize.y - ImGui::GetFrameHeight() * 2.5f);
    ImGui::SetNextWindowSize({presets_menu_width(), height});
    if (!ImGui::BeginPopup(id, ImGuiWindowFlags_NoMove)) return;
    if (presets.empty()) ImGui::TextDisabled("No presets ship with this build.");
    std::string topic;
    for (const PresetEntry& preset : presets) {
        if (preset.topic != topic) {
            if (!topic.empty()) ImGui::Dummy({0, em * 0.3f});
            topic = preset.topic;
            ImGui::TextDisabled("%s", topic.c_str());
            ImGui::Separator();
        }
        if (entry(preset, preset.key == open, ImGui::GetContentRegionAvail().x)) {
            requests.load_preset = preset.key;
            ImGui::CloseCurrentPopup();
        }
    }
    ImGui::EndPopup();
}

}  // namespace si
