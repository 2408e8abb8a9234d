// Up axis and unit of a scene's file.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "renderer/scene/scene.h"

namespace si {

/// Returns the rotation from a file's axes to those of the scene, in which y points up.
/// @param up the axis that points up in the file; UpAxis::File: no rotation
glm::dmat3 y_up_from(UpAxis up);

/// Returns the file axis that a rotation turns upwards, if the rotation is one that y_up_from() returns; UpAxis::Y for
/// any other matrix.
UpAxis up_axis_of(const glm::dmat3& rotation);

/// Returns the value of the setting scene.up for an axis, such as "z".
std::string up_axis_key(UpAxis up);

/// Turns and scales a loaded scene to the up axis and unit that the user has chosen for its file. Skins, animations,
/// cameras and lights follow. Scene::file_up and Scene::file_unit_m are the axis and unit that the loader has applied,
/// and are updated. Call before finalise().
void apply_file_choices(Scene& scene, const FileChoices& choices);

/// Transforms a loaded scene, with its cameras and lights, from the space of its file to metres, y up, right-handed. A
/// mirroring transform does not mirror cameras and lights. Unless the transform is the identity, animations are dropped
/// with a warning. Call before finalise().
/// @param world transform from file to scene
void apply_world(Scene& scene, const glm::dmat4& world);

}  // namespace si
