// Over the scene picture while another scene is being read: which one, how far, and a way out.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "ui/panels.h"
#include "ui/theme.h"

namespace si {

void draw_loading(const EditorFrame& frame, EditorActions& actions, float left, float top, float width) {
    if (!frame.loading) return;
    const float em = ImGui::GetFontSize(), pad = em * 0.5f;
    const float wide = std::min(width - 2 * pad, em * 28);
    ImGui::SetCursorScreenPos({left + (width - wide) / 2, top + em * 2});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::kVeil);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(pad, pad));
    // A window of its own, so that the mouse over it is not over the picture.
    ImGui::BeginChild("loading", {wide, ImGui::GetFrameHeight() + 2 * pad}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
    const std::string text = fmt::format("Loading {} … {} %", scene_label(frame.loading->name),
                                         int(std::clamp(frame.loading->progress, 0.0, 1.0) * 100));
    const float button = ImGui::CalcTextSize("Cancel").x + 2 * ImGui::GetStyle().FramePadding.x;
    const float bar = ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x;
    ImGui::ProgressBar(float(frame.loading->progress), {std::max(bar, em), 0}, text.c_str());
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) actions.cancel_load = true;
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

}  // namespace si
