// Casters that face culling removes from a shadow map altogether. Front-face culling loses floors, single planes and
// open meshes, which have no back.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Object that casts no shadow because face culling removes every triangle from the light's map.
struct LostCaster {
    int object = 0;             ///< index into Scene::objects
    Cull cull = Cull::None;     ///< culling mode in force
    std::size_t triangles = 0;  ///< number of triangles of the object
};

/// Finds the objects that should cast a shadow under a light but leave nothing in its map, because culling removes all
/// their triangles. Faces are classified as by the rasteriser: by winding as seen from the light, mirroring transforms
/// undone. Takes time proportional to the triangles of lost objects only. Returns an empty list when the light has no
/// map or nothing is culled.
std::vector<LostCaster> lost_casters(const Scene& scene, const Settings& settings, const FittedLight& light);

/// Formats casters that face culling removes from the map as warnings with the fix: one line per object, and one line
/// for all above the limit.
/// @param max_lines limit of objects that are named
std::vector<std::string> lost_caster_remarks(const Scene& scene, const std::vector<LostCaster>& lost,
                                             std::size_t max_lines = 5);

}  // namespace si
