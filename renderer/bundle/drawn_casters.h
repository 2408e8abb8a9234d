// Casters of a scene that were not drawn into maps, by the names that a bundle lists.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "renderer/scene/scene.h"

namespace si {

/// Difference between the objects of a scene and the node paths that a bundle (an engine's frame) lists as drawn into a
/// shadow map.
struct DrawnCasters {
    std::set<std::string> left_out;  ///< node paths of objects that were not drawn
    std::size_t unknown = 0;         ///< listed paths that name no object with triangles
};

/// Compares the objects of a scene with the casters that an engine has drawn into a shadow map, to find those left out.
/// @param drawn node paths of the drawn casters, as in BundleMap::drawn
DrawnCasters drawn_casters(const Scene& scene, const std::set<std::string>& drawn);

}  // namespace si
