// Which objects a camera draws, and in what order, so that little is shaded that something nearer hides.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "renderer/view/culling/box_culling.h"

namespace si {

/// Numbers of two boxes of a sequence, the earlier first.
using BoxPair = std::pair<std::uint32_t, std::uint32_t>;

/// The pairs of boxes that touch: only in those may one surface lie exactly in another's place.
/// @param room_m by which boxes are larger, for what floats make of surfaces
/// @returns nothing where finding them takes too long to be worth it
std::optional<std::vector<BoxPair>> touching_boxes(std::span<const SkewBox> boxes, double room_m);

/// Where an object stands in the order.
struct SortedBox {
    int group = 0;     ///< of lower groups all are drawn before any of higher ones
    double far_m = 0;  ///< how far the farthest of it lies along the viewing direction: what encloses others comes late
    bool seen = false;  ///< else it is left out
};

/// The numbers of the boxes that are seen, by groups, the nearest first; of two that touch the earlier stays the
/// earlier, so that of surfaces in one place the same one wins wherever the camera is. Many boxes are told apart by
/// steps of their distance alone, so that runs of like ones stay together.
/// @param touching of all boxes, seen or not
std::vector<std::uint32_t> sort_front_to_back(std::span<const SortedBox> boxes, std::span<const BoxPair> touching);

}  // namespace si
