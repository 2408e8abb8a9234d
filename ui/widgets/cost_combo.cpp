#include "ui/widgets/cost_combo.h"

#include <imgui.h>

#include <string>

#include "ui/widgets/combo.h"
#include "ui/widgets/text.h"

namespace si {

void choose_cost(const char* label, CostCase& cost) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 13);
    ImGui::PushID(label);
    if (begin_combo("##cost", std::string(cost_row(cost).when))) {
        for (std::size_t i = 0; i < cost_cases().size(); ++i) {
            const CostRow& row = cost_cases()[i];
            if (ImGui::Selectable(std::string(row.when).c_str(), cost == CostCase(i))) cost = CostCase(i);
            plain_tooltip(std::string(row.help));
        }
        ImGui::EndCombo();
    } else if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("Of which frames times are, ms. %s", std::string(cost_row(cost).help).c_str());
    }
    ImGui::PopID();
}

}  // namespace si
