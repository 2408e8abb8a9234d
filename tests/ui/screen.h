// Screen size and layout of the editor's tests.
#pragma once

#include "ui/state/editor_ui.h"

namespace si::test {

/// Size of the test screen, pixels.
inline constexpr int kWidth = 1280, kHeight = 720;

/// Layout with every panel open and the map at the side of the scene. Positions in tests refer to this layout.
inline const EditorLayout kWideLayout{
    .settings_width = 24, .bottom_height = 15.6f, .strip_open = true, .map_place = MapSpot::NextToScene};

}  // namespace si::test
