// Comparison of the shown picture with another one.
#pragma once

#include <string>

#include "renderer/frame/frame.h"

namespace si {

/// Arrangement of the shown picture and the picture that it is compared with. Alone: only the compared picture, while a
/// key is held.
enum class ComparisonView { Off, Swipe, SideBySide, Difference, Alone };
/// State of the comparison of the scene picture with another one: arrangement, kind of the other picture, and dividing
/// line.
struct PictureComparison {
    ComparisonView view = ComparisonView::Off;
    bool reference = true;  ///< compares with the ray-traced reference; else with the settings of PictureState::compare
    float at = 0.5f;    ///< place of the swipe's line, share of the picture's width; the shown picture is left of it
    bool held = false;  ///< the line is being dragged
};

/// Data of the comparison of the scene picture with another one: the other picture, and the difference image of these
/// two.
struct PictureComparisonFacts {
    Image picture;        ///< picture to compare with; no texture: not drawn yet
    Image difference;     ///< no texture: not drawn yet
    std::string label;    ///< name of the compared picture: "Truth", "PCF 5x5"
    std::string problem;  ///< reason why there is no picture to compare with
    double mae = 0;       ///< mean |A - B| of the pictures' channels, 0..1; valid with `difference`
};

}  // namespace si
