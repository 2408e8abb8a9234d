// Colours, fonts and spacing of the editor, dark or light. Greys only: colour is kept for data.
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace si::theme {

/// Colours of the light or the dark theme of the editor. Hovered and pressed widgets have greys of their own, which are
/// not among the members. Every text is readable on its background (tests/ui/theme_test.cpp).
struct Colours {
    ImU32 text, muted, faint;
    ImU32 panel, popup, title, well;  ///< grounds; well: behind pictures and inputs
    ImU32 line;
    ImU32 accent;  ///< changed values
    ImU32 error, warning;
    ImU32 note;  ///< background of notes for the user
    ImU32 done;  ///< filled part of a progress bar
    ImU32 bar;   ///< bars of a plot
};
/// Returns the colours of the editor's light or dark theme.
const Colours& colours(bool light);
/// Returns the colours of the editor's theme in use.
const Colours& colours();

/// Function object for a colour of the theme in use. A call returns the present value: theme::text().
struct ThemeColour {
    ImU32 Colours::*colour;
    ImU32 operator()() const { return colours().*colour; }
};
inline constexpr ThemeColour text{&Colours::text};
inline constexpr ThemeColour muted{&Colours::muted};
inline constexpr ThemeColour faint{&Colours::faint};
inline constexpr ThemeColour panel{&Colours::panel};
inline constexpr ThemeColour well{&Colours::well};
inline constexpr ThemeColour line{&Colours::line};
inline constexpr ThemeColour accent{&Colours::accent};
inline constexpr ThemeColour error{&Colours::error};
inline constexpr ThemeColour warning{&Colours::warning};

// Text over kVeil on pictures, in both themes.
inline constexpr ImU32 kOnPicture = IM_COL32(222, 222, 220, 255);
inline constexpr ImU32 kMutedOnPicture = IM_COL32(170, 170, 168, 255);
inline constexpr ImU32 kWarningOnPicture = IM_COL32(226, 180, 92, 255);
inline constexpr ImU32 kAxes[3] = {IM_COL32(222, 110, 98, 255), IM_COL32(126, 186, 96, 255),
                                   IM_COL32(104, 152, 224, 255)};  ///< x, y, z

// Marks in the scene picture and the map: one hue a thing, the same in both (tests/ui/theme_test.cpp keeps them apart).
inline constexpr ImU32 kLight = IM_COL32(236, 186, 96, 255);     ///< frusta and handles of lights
inline constexpr ImU32 kLit = IM_COL32(255, 244, 190, 255);      ///< lit rays and kernel taps
inline constexpr ImU32 kShadowed = IM_COL32(92, 146, 236, 255);  ///< shadowed rays and kernel taps
inline constexpr ImU32 kOffset = IM_COL32(240, 120, 170, 255);   ///< the normal offset
inline constexpr ImU32 kLinked = IM_COL32(88, 218, 224, 255);    ///< counterpart of the pixel or texel under the mouse
inline constexpr ImU32 kProbed = IM_COL32(170, 226, 90, 255);    ///< the probed pixel and its texels
inline constexpr ImU32 kFrozen = IM_COL32(188, 146, 250, 240);   ///< the frozen camera
inline constexpr ImU32 kSelected = IM_COL32(236, 236, 234, 255);
inline constexpr ImU32 kBounds = IM_COL32(168, 186, 206, 74);  ///< boxes of all casters
inline constexpr ImU32 kLive = IM_COL32(150, 150, 148, 160);   ///< the camera that flies while another is frozen
inline constexpr ImU32 kShade = IM_COL32(0, 0, 0, 160);        ///< around marks, so that they show on any ground

inline constexpr ImU32 kVeil = IM_COL32(18, 18, 19, 225);  ///< under text on pictures

inline ImU32 rgb(const std::array<std::uint8_t, 3>& c) {
    return IM_COL32(c[0], c[1], c[2], 255);
}

/// Adds the editor's fonts to the font atlas of the current ImGui context: [0] body, [1] strong, [2] small, [3]
/// verdict, [4] heading, [5] value. Call before the first frame. @param scale 1: a screen of about 96 dots per inch
void load_fonts(float scale);
/// Sets spacing and colours of the current ImGui context to the editor's style. Colours are dark until set_light().
/// @param scale 1: a screen of about 96 dots per inch
void apply_style(float scale);
/// Switches the editor's colours to the light theme or the dark one.
void set_light(bool light);

/// Converts an RGB colour with components 0 to 1 to an opaque ImGui colour.
ImU32 colour(const glm::vec3& rgb);

/// Returns the editor's bold font, for headings and names.
ImFont* strong();
/// Returns the editor's largest font, bold, for the verdict on a pixel.
ImFont* verdict();
/// Returns the editor's font of headings: medium weight, between body and verdict in size.
ImFont* heading();
/// Returns the editor's font of values: medium weight, in the size of body text.
ImFont* value();
/// Returns the editor's small font, for help, and for marks over pictures and plots.
ImFont* small();

}  // namespace si::theme
