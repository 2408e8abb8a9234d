// Width of buttons before they are drawn.
#pragma once

#include <imgui.h>

namespace si {

/// Returns the width of an ImGui button with that label, pixels.
inline float button_width(const char* label) {
    return ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
}

}  // namespace si
