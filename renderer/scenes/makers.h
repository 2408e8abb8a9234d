// Makers of the scenes of builtin_scenes(), one file each (basic.cpp holds the three small ones).
#pragma once

#include "renderer/scene/scene.h"

namespace si {

Scene make_stage_scene();
Scene make_boxes_scene();
Scene make_teapot_scene();
Scene make_plane_scene();
Scene make_landscape_scene();
Scene make_figures_scene();
Scene make_relief_scene();

}  // namespace si
