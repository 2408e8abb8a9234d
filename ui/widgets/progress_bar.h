// A bar that shows the share of work that is done.
#pragma once

#include <string>

namespace si {

/// Formats a duration, rounded up: "12 s" below a minute, else "3 min".
std::string seconds_text(double seconds);

/// Draws a progress bar with a text over it. @param share filled part, 0..1 @param width pixels; 0: the free width
void progress_bar(double share, const std::string& text, float width = 0);

}  // namespace si
