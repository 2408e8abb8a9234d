#include "ui/widgets/slider.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace si {
namespace {

/// Draws the slider's knob as a low bar below its number, and a paler bar from the left end to the knob.
/// @param id ImGui id of the slider
void draw_mark(const ImRect& frame, ImGuiID id, ImGuiDataType type, void* value, const void* least, const void* most,
               const char* format, ImGuiSliderFlags flags) {
    // For an inactive id, ImGui's function returns the knob's place and changes nothing.
    const ImGuiID inactive = ImHashStr("mark", 0, id);
    ImRect knob;
    ImGui::SliderBehavior(frame, inactive, type, value, least, most, format, flags, &knob);
    const ImGuiStyle& style = ImGui::GetStyle();
    const float height = std::max(std::floor(style.FramePadding.y - 0.5f), 2.0f);
    const ImVec2 lo(knob.Min.x, frame.Max.y - height), hi(knob.Max.x, frame.Max.y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool held = ImGui::GetActiveID() == id;
    list.AddRectFilled({frame.Min.x, lo.y}, {lo.x, hi.y}, ImGui::GetColorU32(ImGuiCol_SliderGrab, 0.35f));
    list.AddRectFilled(lo, hi, ImGui::GetColorU32(held ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab));
}

}  // namespace

bool slider(const char* label, ImGuiDataType type, void* value, const void* least, const void* most, const char* format,
            ImGuiSliderFlags flags) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImRect frame(at, {at.x + ImGui::CalcItemWidth(), at.y + ImGui::GetFrameHeight()});
    const ImGuiID id = ImGui::GetID(label);
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, IM_COL32_BLACK_TRANS);
    ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, IM_COL32_BLACK_TRANS);
    const bool changed = ImGui::SliderScalar(label, type, value, least, most, format, flags);
    ImGui::PopStyleColor(2);
    if (ImGui::IsItemVisible() && !ImGui::TempInputIsActive(id))
        draw_mark(frame, id, type, value, least, most, format, flags);
    return changed;
}

}  // namespace si
