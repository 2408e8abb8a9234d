// Slider with its mark below the number, which ImGui's knob would cover.
#pragma once

#include <imgui.h>

namespace si {

/// Draws an ImGui slider whose mark lies below the number, which ImGui's knob would cover. Arguments are those of
/// ImGui::SliderScalar(). Returns true if the value has changed.
bool slider(const char* label, ImGuiDataType type, void* value, const void* least, const void* most, const char* format,
            ImGuiSliderFlags flags);

}  // namespace si
