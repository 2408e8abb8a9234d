// Up axis and unit of a scene's file.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "renderer/scene/scene.h"

namespace si {

/// Returns the rotation from a file's axes to the scene's, in which y is up. UpAxis::File rotates nothing.
glm::dmat3 y_up_from(UpAxis up);

/// Returns the axis that a rotation of y_up_from() turns upwards; UpAxis::Y for any other matrix.
UpAxis up_axis_of(const glm::dmat3& rotation);

/// Returns the value of scene.up that means an axis: "z".
std::string up_axis_key(UpAxis up);

/// Turns and scales a loaded scene, with its skins, animations, cameras and lights, from the up axis and unit that its
/// loader has applied (Scene::file_up, Scene::file_unit_m) to those that are chosen. Call it before finalise().
void apply_file_choices(Scene& scene, const FileChoices& choices);

/// Transforms a loaded scene, with its cameras and lights, from the space of its file to metres, y up, right-handed. A
/// mirrored space keeps cameras unmirrored. Animations stay only where the transform is the identity; a warning tells
/// so. Call it before finalise().
void apply_world(Scene& scene, const glm::dmat4& world);

}  // namespace si
