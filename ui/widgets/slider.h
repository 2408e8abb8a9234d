// Slider whose knob is a low bar below the number. ImGui's own knob would cover the number.
#pragma once

#include <imgui.h>

namespace si {

/// Draws an ImGui slider whose knob is a low bar below the number. ImGui's own knob would cover the number. Arguments
/// are those of ImGui::SliderScalar(). Returns true if the value has changed.
bool slider(const char* label, ImGuiDataType type, void* value, const void* least, const void* most, const char* format,
            ImGuiSliderFlags flags);

}  // namespace si
