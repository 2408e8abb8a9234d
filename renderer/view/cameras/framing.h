// Placement of the automatic camera.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Returns the axes of an orbit camera as columns right, up, back. `right` depends on the azimuth alone, so views
/// straight up and down are no special case.
glm::dmat3 orbit_axes(double azimuth_deg, double elevation_deg, double roll_deg);

/// Moves the eye along the camera's back axis until the bounds fill the picture. Changes eye, focus and height.
void frame_bounds(Camera& c, const Bounds& bounds);

/// Returns true when the automatic camera frames a model together with its shadow: for model files that stand on an
/// automatic ground.
bool should_frame_shadow(const Scene& scene, const Settings& settings);

/// Frames the model of a file together with its shadow. Raises the camera until enough of the shadow is visible.
/// @param c camera with field of view and aspect set; axes, eye, focus and height are overwritten
void frame_with_shadow(Camera& c, const Scene& scene);

}  // namespace si
