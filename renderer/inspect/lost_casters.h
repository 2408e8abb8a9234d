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

/// Rule that keeps a caster out of a light's map.
enum class LostBy {
    Culling,    ///< face culling removes every triangle
    NearPlane,  ///< the whole object lies before the near plane
    Blending,   ///< the material blends, and caster.blend is none
};

/// Returns the name of a rule in JSON: "culling", "near plane" or "blending".
std::string_view lost_by_key(LostBy by);

/// Object that is to cast a shadow and leaves nothing in the light's map.
struct LostCaster {
    int object = 0;  ///< index into Scene::objects
    LostBy by = LostBy::Culling;
    Cull cull = Cull::None;     ///< culling mode in force
    std::size_t triangles = 0;  ///< number of triangles of the object
};

/// Finds the objects that should cast a shadow under a light but leave nothing in its map. Faces are classified as by
/// the rasteriser: by winding as seen from the light, mirroring transforms undone. Takes time proportional to the
/// number of objects and to the triangles of lost ones. Returns an empty list when the light has no map.
std::vector<LostCaster> lost_casters(const Scene& scene, const Settings& settings, const FittedLight& light);

/// Returns those lost casters that have a triangle between a surface point and the light.
std::vector<LostCaster> lost_casters_before(const Scene& scene, const std::vector<LostCaster>& lost,
                                            const FittedLight& light, const glm::dvec3& point_ws);

/// Returns a lost caster as a sentence with its fix. @param light index of light.*
std::string lost_caster_text(const Scene& scene, const LostCaster& lost, int light);

/// Formats lost casters as warnings with the fix: one line per object, and one line for all above the limit.
/// @param light index of light.*
/// @param max_lines limit of objects that are named
std::vector<std::string> lost_caster_remarks(const Scene& scene, const std::vector<LostCaster>& lost, int light,
                                             std::size_t max_lines = 5);

}  // namespace si
