// Strip over the scene picture while another scene is loading: name, progress and a button to cancel.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/state/panels.h"
#include "ui/widgets/button_width.h"
#include "ui/widgets/theme.h"

namespace si {
namespace {

std::string loading_text(const LoadingFacts& loading) {
    const std::string name = scene_label(loading.name);
    if (loading.progress >= 1) return fmt::format("Drawing {} for the first time …", name);
    std::string text = fmt::format("Loading {} … {} %", name, int(std::max(loading.progress, 0.0) * 100));
    if (loading.seconds_left > 0) text += fmt::format(", {} left", seconds_text(loading.seconds_left));
    return text;
}

}  // namespace

void draw_loading(const EditorFrame& frame, EditorRequests& requests, float left, float top, float width) {
    if (!frame.loading) return;
    const float em = ImGui::GetFontSize(), pad = em * 0.5f;
    const float wide = std::min(width - 2 * pad, em * 28);
    ImGui::SetCursorScreenPos({left + (width - wide) / 2, top + em * 2});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::kVeil);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(pad, pad));
    // The strip is a window of its own, so that the mouse over it does not act on the picture.
    ImGui::BeginChild("loading", {wide, ImGui::GetFrameHeight() + 2 * pad}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
    const float button = button_width("Cancel");
    const float bar = ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x;
    progress_bar(frame.loading->progress, loading_text(*frame.loading), std::max(bar, em));
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) requests.cancel_load = true;
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

}  // namespace si
