// Lights added, copied, reordered and deleted in the settings. Each keeps its own settings; view.light follows.
#pragma once

#include "renderer/settings/settings.h"

namespace si {

/// Returns true below kMaxLights lights.
bool can_add_light(const Settings& settings);
/// Adds a light with default settings from a direction that no other light has, and shows it. Does nothing at
/// kMaxLights.
void add_light(Settings& settings);
/// Inserts a copy of a light after it, without its name, and shows it. Does nothing without that light or at
/// kMaxLights.
void copy_light(Settings& settings, int light);
/// Deletes a light; does nothing without it.
void delete_light(Settings& settings, int light);
/// Returns true if that light alone is on.
bool is_solo(const Settings& settings, int light);
/// Switches all other lights off; all on if they are off already.
void solo_light(Settings& settings, int light);
/// Moves a light `places` on in the list (below 0: back), clamped to the list, and shows it.
void move_light(Settings& settings, int light, int places);

}  // namespace si
