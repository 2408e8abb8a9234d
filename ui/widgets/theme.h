// Colours, fonts and spacing of the editor. Greys only: colour is kept for data.
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace si::theme {

inline constexpr ImU32 kText = IM_COL32(222, 222, 220, 255);
inline constexpr ImU32 kMuted = IM_COL32(146, 146, 144, 255);
inline constexpr ImU32 kFaint = IM_COL32(96, 96, 95, 255);
inline constexpr ImU32 kPanel = IM_COL32(35, 35, 36, 255);
inline constexpr ImU32 kWell = IM_COL32(23, 23, 24, 255);  ///< behind pictures and inputs
inline constexpr ImU32 kLine = IM_COL32(58, 58, 59, 255);
inline constexpr ImU32 kAccent = IM_COL32(232, 200, 128, 255);  ///< changed values
inline constexpr ImU32 kError = IM_COL32(236, 116, 100, 255);
inline constexpr ImU32 kWarning = IM_COL32(226, 180, 92, 255);
inline constexpr ImU32 kAxes[3] = {IM_COL32(222, 110, 98, 255), IM_COL32(126, 186, 96, 255),
                                   IM_COL32(104, 152, 224, 255)};  ///< x, y, z

// Marks in the scene picture and the map: one hue a thing, the same in both (tests/ui/theme_test.cpp keeps them apart).
inline constexpr ImU32 kLight = IM_COL32(236, 186, 96, 255);     ///< frusta and handles
inline constexpr ImU32 kLit = IM_COL32(255, 244, 190, 255);      ///< what light reaches
inline constexpr ImU32 kShadowed = IM_COL32(92, 146, 236, 255);  ///< what is kept from it
inline constexpr ImU32 kOffset = IM_COL32(240, 120, 170, 255);   ///< the normal offset
inline constexpr ImU32 kLinked = IM_COL32(88, 218, 224, 255);    ///< under the mouse in the other picture
inline constexpr ImU32 kProbed = IM_COL32(170, 226, 90, 255);    ///< the probed pixel and its texels
inline constexpr ImU32 kFrozen = IM_COL32(188, 146, 250, 240);   ///< the frozen camera
inline constexpr ImU32 kSelected = IM_COL32(236, 236, 234, 255);
inline constexpr ImU32 kBounds = IM_COL32(168, 186, 206, 74);  ///< boxes of all casters
inline constexpr ImU32 kLive = IM_COL32(150, 150, 148, 160);   ///< the camera that flies while another is frozen
inline constexpr ImU32 kShade = IM_COL32(0, 0, 0, 160);        ///< around marks, so that they show on any ground

inline constexpr ImU32 kNote = IM_COL32(50, 50, 52, 255);  ///< behind remarks to the person
inline constexpr ImU32 kVeil = IM_COL32(18, 18, 19, 205);  ///< under text on pictures

inline constexpr ImU32 kDone = IM_COL32(92, 84, 62, 255);  ///< of a progress bar: dark enough for text on it

inline ImU32 rgb(const std::array<std::uint8_t, 3>& c) {
    return IM_COL32(c[0], c[1], c[2], 255);
}

/// Fills the font atlas of the current ImGui context: [0] body, [1] strong, [2] small. Call before the first frame.
void load_fonts(float scale);
/// Sets the style of the current ImGui context; `scale` 1 is for a screen of about 96 dots per inch.
void apply(float scale);

/// An opaque colour; components 0 to 1, as shaders have them.
ImU32 colour(const glm::vec3& rgb);

ImFont* strong();
ImFont* small();

}  // namespace si::theme
