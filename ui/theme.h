// Colours, fonts and spacing of the editor. Greys only: colour is kept for data.
#pragma once

#include <imgui.h>

namespace si::theme {

inline constexpr ImU32 kText = IM_COL32(222, 222, 220, 255);
inline constexpr ImU32 kMuted = IM_COL32(146, 146, 144, 255);
inline constexpr ImU32 kFaint = IM_COL32(96, 96, 95, 255);
inline constexpr ImU32 kPanel = IM_COL32(35, 35, 36, 255);
inline constexpr ImU32 kWell = IM_COL32(23, 23, 24, 255);  ///< behind pictures and inputs
inline constexpr ImU32 kLine = IM_COL32(58, 58, 59, 255);
inline constexpr ImU32 kAccent = IM_COL32(232, 200, 128, 255);  ///< changed values, the light
inline constexpr ImU32 kError = IM_COL32(236, 116, 100, 255);
inline constexpr ImU32 kWarning = IM_COL32(226, 180, 92, 255);
inline constexpr ImU32 kAxes[3] = {IM_COL32(222, 110, 98, 255), IM_COL32(126, 186, 96, 255),
                                   IM_COL32(104, 152, 224, 255)};  ///< x, y, z
inline constexpr ImU32 kLit = IM_COL32(255, 240, 176, 255);       ///< what light reaches
inline constexpr ImU32 kShadowed = IM_COL32(92, 146, 236, 255);   ///< what is kept from it
inline constexpr ImU32 kFrozen = IM_COL32(150, 214, 206, 230);      ///< the frozen camera
inline constexpr ImU32 kSelected = IM_COL32(236, 236, 234, 255);
inline constexpr ImU32 kNote = IM_COL32(50, 50, 52, 255);  ///< behind remarks to the person
inline constexpr ImU32 kVeil = IM_COL32(18, 18, 19, 205);  ///< under text on pictures

inline constexpr ImU32 kDone = IM_COL32(92, 84, 62, 255);  ///< of a progress bar: dark enough for text on it

/// Fills the font atlas of the current ImGui context: [0] body, [1] strong, [2] small. Call before the first frame.
void load_fonts(float scale);
/// Sets the style of the current ImGui context; `scale` 1 is for a screen of about 96 dots per inch.
void apply(float scale);

ImFont* strong();
ImFont* small();

}  // namespace si::theme
