// What the picture shown is held against: how, and what is known of it.
#pragma once

#include <string>

#include "renderer/frame/frame.h"

namespace si {

/// What the picture shown is held against, and how. Alone: the other one is all that is seen, while a key is held.
enum class AgainstView { Off, Swipe, SideBySide, Difference, Alone };
struct Against {
    AgainstView view = AgainstView::Off;
    bool reference = true;  ///< the ray-traced truth; else what EditorState::compare names
    float at = 0.5f;        ///< where the swipe's line stands: share of the picture's width, what is shown on its left
    bool held = false;      ///< the line is being dragged
};

/// The picture that the one shown is held against.
struct AgainstFacts {
    Image picture, difference;  ///< without a texture: not there yet
    std::string label;          ///< what it shows: "Truth", "PCF 5x5"
    std::string problem;        ///< why there is none
    double mae = 0;             ///< mean |A - B| of the pictures' channels, 0..1; with the difference
};

}  // namespace si
