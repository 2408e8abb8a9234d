// Procedural terrain of the landscape scene, the same on every machine.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

inline constexpr double kTerrainSize_m = 2048;   ///< side of the square terrain, centred on the origin
inline constexpr double kWaterLevel_m = -9;      ///< height of the lake's surface, as terrain_height() measures it
inline constexpr double kVillageRadius_m = 150;  ///< radius of the level ground around the origin

/// Returns the height of the landscape scene's terrain at (x, z), in metres above the village.
double terrain_height(double x, double z);
/// Returns the slope of the landscape scene's terrain at (x, z), as rise over run.
double terrain_slope(double x, double z);
/// Makes the terrain of the landscape scene as a grid of `cells` by `cells`, with normals and linear vertex colours,
/// without texture coordinates.
Mesh make_terrain(int cells);

/// Returns smooth value noise in [-1, 1] at (x, z), with features about one unit wide, for procedural scenes. The same
/// on every machine.
double smooth_noise(double x, double z, std::uint32_t seed);

}  // namespace si
