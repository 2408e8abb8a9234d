// Makers of the scenes of builtin_scenes(), one file each (basic.cpp holds the three small ones).
#pragma once

#include "renderer/scene/scene.h"

namespace si {

/// Makes the stage, the default scene: its objects provoke acne, peter-panning and aliasing at once.
Scene make_stage_scene();
/// Makes boxes that stand on, hover over and lean against a floor.
Scene make_boxes_scene();
/// Makes Newell's teapot on a floor.
Scene make_teapot_scene();
/// Makes one striped plane from 1 m to 100 m in front of the camera, for depth precision.
Scene make_plane_scene();
/// Makes two kilometres of hills, trees and a village, too large for one shadow map.
Scene make_landscape_scene();
/// Makes three figures in fixed poses (walking, reaching, kneeling) among simple objects.
Scene make_figures_scene();
/// Makes flat surfaces whose cobbles are only a normal map.
Scene make_relief_scene();

}  // namespace si
