// The choice of an overlay, by what it is looked at for.
#pragma once

#include <string>
#include <string_view>

#include "renderer/settings/settings.h"

namespace si {

/// A combo for a row whose choices are the overlays. @param width of it, pixels. Returns whether it changed.
bool overlay_widget(Settings& settings, std::string_view key, float width);

/// What is held while a digit is pressed.
struct HeldKeys {
    bool shift = false, alt = false, ctrl = false;
};
/// The overlay that a digit of 1 to 9 stands for: its row + 1; of several keys held, or where there is none: 0.
int overlay_of_digit(int digit, const HeldKeys& held);
/// "4", "Shift+4": what is pressed for that row + 1; 0 for none.
std::string overlay_key(int number);

/// The setting that holds the overlay of a pane, from the first on.
std::string_view overlay_setting(int pane);

}  // namespace si
