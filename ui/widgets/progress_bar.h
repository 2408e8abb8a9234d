// A bar that shows the share of work that is done.
#pragma once

#include <string>

namespace si {

/// Returns a duration rounded up: "12 s", below a minute, else "3 min".
std::string seconds_text(double seconds);

/// Draws a bar filled from the left to `share`, 0..1, with a text over it. @param width pixels; 0: all there is
void progress_bar(double share, const std::string& text, float width = 0);

}  // namespace si
