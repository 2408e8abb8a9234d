// Choice of an overlay, grouped by purpose, and its keys.
#pragma once

#include <string>
#include <string_view>

#include "renderer/settings/settings.h"

namespace si {

/// Draws a combo for a setting that chooses an overlay of the scene picture, grouped by purpose. Returns true if the
/// value has changed. @param key dotted key of the setting @param width pixels
bool overlay_widget(Settings& settings, std::string_view key, float width);

/// Modifier keys that are held with a digit key to choose an overlay.
struct HeldKeys {
    bool shift = false, alt = false, ctrl = false;
};
/// Returns the number of the overlay that a digit key shows together with the held modifier keys: 1 for the first row
/// of the overlay table. Returns 0 if the keys show no overlay, as with Ctrl. @param digit the digit, 1 to 9
int overlay_of_digit(int digit, const HeldKeys& held);
/// Returns the keyboard shortcut that shows an overlay, such as "4" or "Shift+4"; empty if there is none.
/// @param number the overlay's number: 1 for the first row of the overlay table; 0 for no overlay, with the shortcut
/// "0"
std::string overlay_key(int number);

/// Returns the key of the setting that chooses the overlay of a pane (one of up to four scene pictures). @param pane
/// index of the pane, 0 to 3; clamped
std::string_view overlay_setting(int pane);

}  // namespace si
