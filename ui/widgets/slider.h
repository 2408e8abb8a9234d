// A slider whose mark lies below its number, where ImGui's knob would stand over it.
#pragma once

#include <imgui.h>

namespace si {

/// As ImGui::SliderScalar(): dragged, or typed into after Ctrl+click.
bool slider(const char* label, ImGuiDataType type, void* value, const void* least, const void* most, const char* format,
            ImGuiSliderFlags flags);

}  // namespace si
