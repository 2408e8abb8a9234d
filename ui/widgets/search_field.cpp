#include "ui/widgets/search_field.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "ui/widgets/text.h"

namespace si {

void search_field(const char* id, const char* hint, std::string& text, float leave, const char* about) {
    const float width = std::max(ImGui::GetContentRegionAvail().x - leave, ImGui::GetFontSize() * 3);
    const float side = ImGui::GetFrameHeight();
    const bool clears = !text.empty();
    ImGui::PushID(id);
    ImGui::SetNextItemWidth(clears ? width - side : width);
    const float room = width - 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::InputTextWithHint("##text", beginning_that_fits(hint, room, ImGui::GetFont()).c_str(), &text);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
        ImGui::SetTooltip("All words have to be there, in any order%s", about);
    if (clears) {
        ImGui::SameLine(0, 0);
        if (ImGui::Button("×", {side, side})) text.clear();
        plain_tooltip("Clears the search");
    }
    ImGui::PopID();
}

}  // namespace si
