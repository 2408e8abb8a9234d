// Placement of a scene in the world by scene.distance, scene.direction and scene.scale.
#pragma once

#include <glm/glm.hpp>

#include "renderer/settings/settings.h"

namespace si {

/// Returns the unit vector in world space along which scene.direction moves the scene.
glm::dvec3 placement_direction(PlacedAlong along);

/// Returns the transform that places a scene in the world by the settings scene.scale, distance and direction
/// (Scene::placement): a scale about the world's origin, then a translation.
glm::dmat4 placement_of(const SceneSettings& settings);

/// Adapts settings to a new placement of the scene so that they show the same view. Moves the manual camera and scales
/// lengths in metres (lights, biases, radii) with the scene, within their ranges. `settings.scene` is not changed.
/// @param from, to the scene settings with the placement before and after
void carry_settings(Settings& settings, const SceneSettings& from, const SceneSettings& to);

/// Returns the origin relative to which shaders compute positions, to limit float rounding: the world's origin if
/// map.origin is `world`, else `nearby`.
/// @param nearby a point close to the positions, world space
glm::dvec3 shader_origin(const Settings& settings, const glm::dvec3& nearby);

/// Returns true when two scene settings place the scene by the same transform (scene.distance, direction, scale).
bool same_placement(const SceneSettings& a, const SceneSettings& b);

}  // namespace si
