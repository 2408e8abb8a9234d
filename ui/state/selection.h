// Objects of the scene by node path: their boxes.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "renderer/scene/scene.h"

namespace si {

/// World bounds of all that the node with this path places; empty when there is none.
Bounds bounds_of(const Scene& scene, const std::string& path);

/// Eight world corners of the box around what the node places, in the node's own axes; bit 0 of the index is x, bit 1
/// y, bit 2 z. Nothing when it places nothing.
std::optional<Box> box_of(const Scene& scene, const std::string& path);

}  // namespace si
