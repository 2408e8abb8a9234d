// Front-to-back draw order of visible objects, which reduces the shading of hidden surfaces.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "renderer/view/culling/box_culling.h"

namespace si {

/// Indices of two boxes of a sequence, the smaller first.
using BoxPair = std::pair<std::uint32_t, std::uint32_t>;

/// Returns the pairs of boxes that touch each other. Only such boxes can contain coplanar surfaces. Among coplanar
/// surfaces the draw order decides which one is visible. Sorting must therefore keep the order of touching boxes.
/// @param room_m padding of the boxes in metres, for float rounding of surfaces
/// @return empty optional when there are too many boxes or pairs to find in a few milliseconds
std::optional<std::vector<BoxPair>> touching_boxes(std::span<const SkewBox> boxes, double room_m);

/// Sort key of one object for sort_front_to_back().
struct SortedBox {
    int group = 0;  ///< draw group: lower groups are drawn first
    double far_m =
        0;  ///< largest distance along the viewing direction in metres; large objects that enclose others come late
    bool seen = false;  ///< visible; other objects are left out
};

/// Returns the indices of the visible objects' boxes in drawing order: by draw group (SortedBox::group), and front to
/// back within a group. Of two touching boxes the one with the smaller index stays first, so that the winner between
/// coplanar surfaces does not depend on the camera. Above 512 boxes distances are quantised, so that objects of one
/// batch (drawn by one draw call) stay together.
/// @param touching touching_boxes() of all boxes, visible or not
std::vector<std::uint32_t> sort_front_to_back(std::span<const SortedBox> boxes, std::span<const BoxPair> touching);

}  // namespace si
