// Casters that a culling mode removes from a shadow map altogether (catalogue of the trouble with front-face culling:
// floors, single planes and open meshes have no back).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

struct LostCaster {
    int object = 0;             ///< index into Scene::objects
    Cull cull = Cull::None;     ///< in force for it
    std::size_t triangles = 0;  ///< all of them face the way that is culled
};

/// The objects that are to cast a shadow under `light` but leave nothing in its map, because culling removes each of
/// their triangles. Empty when the light casts nothing or nothing is culled. Faces count as the rasteriser counts them:
/// by their winding as seen from the light, a mirroring transform undone; edge-on triangles leave nothing either way.
/// Takes time proportional to the triangles of lost objects only.
std::vector<LostCaster> lost_casters(const Scene& scene, const Settings& settings, const FittedLight& light);

/// A line per lost object that names it and the remedy, at most `most` of them and one for the rest.
std::vector<std::string> lost_caster_remarks(const Scene& scene, const std::vector<LostCaster>& lost,
                                             std::size_t most = 5);

}  // namespace si
