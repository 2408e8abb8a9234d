// Casters that leave nothing in a shadow map. Front-face culling loses floors, single planes and open meshes, which
// have no back; the near plane loses what lies before it; blended materials do not cast by default.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"
#include "renderer/view/lights/light.h"

namespace si {

/// Reason why a shadow caster is missing from a light's shadow map.
enum class LostBy {
    Culling,    ///< face culling removes every triangle
    NearPlane,  ///< the whole object lies before the near plane
    Blending,   ///< the material blends, and caster.blend is none
};

/// Returns the JSON name of the reason why a caster is missing from a shadow map: "culling", "near plane" or
/// "blending".
std::string_view lost_by_key(LostBy by);

/// Object that should cast a shadow but is missing from a light's shadow map, with the reason.
struct LostCaster {
    int object = 0;  ///< index into Scene::objects
    LostBy by = LostBy::Culling;
    Cull cull = Cull::None;     ///< face culling in force for the object
    std::size_t triangles = 0;  ///< number of triangles of the object
};

/// Finds the objects that should cast a shadow under a light but leave nothing in its shadow map. Front and back faces
/// follow the winding as seen from the light; a mirroring transform does not swap them. Takes time proportional to the
/// number of objects and to the triangles of the objects found. Returns an empty list when the light has no map.
std::vector<LostCaster> lost_casters(const Scene& scene, const Settings& settings, const FittedLight& light);

/// Returns the lost casters that have a triangle between a surface point and the light, to explain a missing shadow at
/// the point.
/// @param lost objects missing from the light's shadow map, from lost_casters()
/// @param point_ws surface point, world space
std::vector<LostCaster> lost_casters_before(const Scene& scene, const std::vector<LostCaster>& lost,
                                            const FittedLight& light, const glm::dvec3& point_ws);

/// Returns a sentence that names an object missing from a light's shadow map, the reason, and the setting that fixes
/// it. @param light index of the light in the settings light.*
std::string lost_caster_text(const Scene& scene, const LostCaster& lost, int light);

/// Formats a warning for each object that is missing from a light's shadow map, with the setting that fixes it. One
/// further line counts the objects above the limit.
/// @param lost objects from lost_casters() @param light index of the light in the settings light.* @param max_lines
/// limit of objects that are named
std::vector<std::string> lost_caster_remarks(const Scene& scene, const std::vector<LostCaster>& lost, int light,
                                             std::size_t max_lines = 5);

}  // namespace si
