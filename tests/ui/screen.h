// How large the screen is that the editor's tests draw on, and where things stand on it.
#pragma once

#include "ui/state/editor_ui.h"

namespace si::test {

inline constexpr int kWidth = 1280, kHeight = 720;

/// Every panel with room beside the others: what places in tests are told for.
inline const EditorLayout kBeside{.settings_width = 24, .bottom_height = 15.6f, .map_place = MapSpot::NextToScene};

}  // namespace si::test
