// Lights added, copied, reordered and deleted in the settings. Each keeps its own settings; view.light follows.
#pragma once

#include "renderer/settings/settings.h"

namespace si {

/// Whether there may be one light more.
bool can_add_light(const Settings& settings);
/// One light more, by default settings but from another side than all others, and shows it; nothing when there are
/// kMaxLights.
void add_light(Settings& settings);
/// A light like light.<i>, without its name, right after it, and shows it; nothing when there is no such light or no
/// room.
void copy_light(Settings& settings, int light);
/// Nothing when there is no such light.
void delete_light(Settings& settings, int light);
/// Whether it alone is on.
bool is_solo(const Settings& settings, int light);
/// Switches all others off; all on where it is solo already.
void solo_light(Settings& settings, int light);
/// Moves light.<i> so many places on (below 0: back), as far as there are lights, and shows it.
void move_light(Settings& settings, int light, int places);

}  // namespace si
