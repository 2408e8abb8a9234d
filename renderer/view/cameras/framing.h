// Placement of the automatic camera.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Returns the axes of a camera that orbits a target, as columns right, up, back. Before the roll, `right` depends on
/// the azimuth alone, so views straight up and down are no special case.
/// @param azimuth_deg,elevation_deg,roll_deg degrees
glm::dmat3 orbit_axes(double azimuth_deg, double elevation_deg, double roll_deg);

/// Places a camera so that it looks at the middle of the bounds and the bounds fill the picture. Sets the camera's eye,
/// focus and height, and keeps its axes.
void frame_bounds(Camera& c, const Bounds& bounds);

/// Returns true when the automatic camera frames a model together with its shadow. It does so for models from files
/// while the setting scene.ground is automatic.
bool should_frame_shadow(const Scene& scene, const Settings& settings);

/// Places a camera so that a model and its shadow fill the picture. Raises the camera in steps until the shadow covers
/// a fixed share of the picture, up to a largest elevation.
/// @param c camera with field of view and aspect set; axes, eye, focus and height are overwritten
void frame_with_shadow(Camera& c, const Scene& scene);

}  // namespace si
