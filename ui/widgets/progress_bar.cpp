#include "ui/widgets/progress_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/widgets/text.h"
#include "ui/widgets/theme.h"

namespace si {

std::string seconds_text(double seconds) {
    const bool short_time = seconds < 60;
    return fmt::format("{:.0f} {}", std::ceil(short_time ? seconds : seconds / 60), short_time ? "s" : "min");
}

void progress_bar(double share, const std::string& text, float width) {
    const ImVec2 at = ImGui::GetCursorScreenPos(), padding = ImGui::GetStyle().FramePadding;
    const ImVec2 size(width > 0 ? width : ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight());
    const ImVec2 end(at.x + size.x, at.y + size.y);
    ImGui::Dummy(size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, end, theme::well(), ImGui::GetStyle().FrameRounding);
    list.AddRectFilled(at, {at.x + size.x * float(std::clamp(share, 0.0, 1.0)), end.y}, theme::colours().done,
                       ImGui::GetStyle().FrameRounding);
    list.AddRect(at, end, theme::line(), ImGui::GetStyle().FrameRounding);
    ImGui::PushClipRect(at, end, true);
    list.AddText({at.x + padding.x, at.y + padding.y}, theme::text(), text.c_str());
    ImGui::PopClipRect();
}

bool progress_strip(const char* id, float left, float room, float y, float ems, std::optional<double> share,
                    const std::string& text) {
    const float em = ImGui::GetFontSize(), pad = em * 0.5f;
    bool cancelled = false;
    const float width = std::min(room - 2 * pad, em * ems);
    ImGui::SetCursorScreenPos({left + (room - width) / 2, y});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme::kVeil);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(pad, pad));
    // The strip is a window of its own, so that the mouse over it does not act on the picture.
    ImGui::BeginChild(id, {width, ImGui::GetFrameHeight() + 2 * pad}, false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
    if (share) {
        const float bar = ImGui::GetContentRegionAvail().x - button_width("Cancel") - ImGui::GetStyle().ItemSpacing.x;
        progress_bar(*share, text, std::max(bar, em));
        ImGui::SameLine();
        cancelled = ImGui::Button("Cancel");
    } else {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(text.c_str());
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    return cancelled;
}

}  // namespace si
