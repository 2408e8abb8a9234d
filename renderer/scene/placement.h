// Where a scene is put in the world: far away, larger or smaller than its file has it.
#pragma once

#include <glm/glm.hpp>

#include "renderer/settings/settings.h"

namespace si {

/// The way of scene.direction, a unit vector.
glm::dvec3 way_of(PlacedAlong along);

/// Scene::placement of scene.distance, scene.direction and scene.scale: scaled about the world's origin, then moved.
glm::dmat4 placement_of(const SceneSettings& settings);

/// Settings for a scene at one place that show the same of it at another: the camera by hand goes along, and what is a
/// length in metres (lights, biases, radii) grows with the scene, as far as its range goes.
/// @param from, to of the scene's place; settings.scene itself is left alone
void carry_settings(Settings& settings, const SceneSettings& from, const SceneSettings& to);

/// What positions that shaders compute with count from, as map.origin says: a place nearby, or the world's origin.
glm::dvec3 counted_from(const Settings& settings, const glm::dvec3& nearby);

/// Whether both put the scene at the same place.
bool same_placement(const SceneSettings& a, const SceneSettings& b);

}  // namespace si
