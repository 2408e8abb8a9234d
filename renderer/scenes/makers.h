// Makers of the scenes of builtin_scenes(), one file each (basic.cpp holds the three small ones).
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Makes the default scene "stage", whose objects provoke acne, peter-panning and aliasing at once.
Scene make_stage_scene();
/// Makes a scene of boxes that stand on, hover over and lean against a floor.
Scene make_boxes_scene();
/// Makes a scene of Newell's teapot on a floor.
Scene make_teapot_scene();
/// Makes a scene of one striped plane from 1 m to 100 m in front of the camera, to show depth precision.
Scene make_plane_scene();
/// Makes a landscape scene: two kilometres of hills, trees and a village, too large for one shadow map.
Scene make_landscape_scene();
/// Makes a scene of three wooden figures in fixed poses (walking, reaching, kneeling) among simple objects.
Scene make_figures_scene();
/// Makes a scene of flat surfaces whose cobbles are only a normal map.
Scene make_relief_scene();

}  // namespace si
