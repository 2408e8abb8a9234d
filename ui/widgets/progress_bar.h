// A bar that shows the share of work that is done.
#pragma once

#include <optional>
#include <string>

namespace si {

/// Formats a duration, rounded up: "12 s" below a minute, else "3 min".
std::string seconds_text(double seconds);

/// Draws a progress bar with a text over it at the ImGui cursor.
/// @param share filled part, 0..1 @param width pixels; 0: the free width
void progress_bar(double share, const std::string& text, float width = 0);

/// Draws a strip over a picture, centred, with a progress bar and a button that cancels the work. Returns true at a
/// press of the button. @param share filled part, 0..1; none: the strip shows the text alone, without a button
/// @param left, room the picture's left edge and width, pixels of the screen @param y upper edge of the strip
/// @param ems largest width of the strip, in heights of the font
bool progress_strip(const char* id, float left, float room, float y, float ems, std::optional<double> share,
                    const std::string& text);

}  // namespace si
