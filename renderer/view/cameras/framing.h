// How the automatic camera is placed.
#pragma once

#include "renderer/projection/camera.h"
#include "renderer/scene/scene.h"
#include "renderer/settings/settings.h"

namespace si {

/// Right, up and back of a view from an azimuth and elevation. `right` comes from the azimuth alone, so that looking
/// straight up or down is nothing special.
glm::dmat3 orbit_axes(double azimuth_deg, double elevation_deg, double roll_deg);

/// Moves the eye along `back` until the bounds fill the picture. Changes eye, focus and height.
void frame_bounds(Camera& c, const Bounds& bounds);

/// Whether the picture is framed for the shadow of what stands there, as of files that are shown on a ground.
bool should_frame_shadow(const Scene& scene, const Settings& settings);

/// Frames what stands in a file's scene, with its shadow, from as high as it takes to see the shadow beside it.
/// @param c whose field of view and aspect count; its axes, eye, focus and height are set
void frame_with_shadow(Camera& c, const Scene& scene);

}  // namespace si
