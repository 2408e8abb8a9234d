// Rolling land as a function of place, the same on every machine.
#pragma once

#include "renderer/scene/scene.h"

namespace si {

inline constexpr double kTerrainSize_m = 2048;   ///< side of the square, centred on the origin
inline constexpr double kWaterLevel_m = -9;      ///< of the lake
inline constexpr double kVillageRadius_m = 150;  ///< level ground around the origin

/// Height in metres above the village at (x, z).
double terrain_height(double x, double z);
/// Slope as rise over run.
double terrain_slope(double x, double z);
/// The land as a grid of `cells` by `cells`, with normals and linear vertex colours; no texture coordinates.
Mesh make_terrain(int cells);

/// Smooth noise in [-1, 1] with features of about one unit.
double smooth_noise(double x, double z, std::uint32_t seed);

}  // namespace si
