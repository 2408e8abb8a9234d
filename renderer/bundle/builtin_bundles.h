// Bundles that the program makes itself: maps of an engine for the hard cases about given maps.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <string_view>

#include "renderer/bundle/bundle_contents.h"

namespace si {

/// Start of the name of a bundle that the program makes itself, as map.bundle takes it: "builtin:strip".
inline constexpr std::string_view kBuiltinBundlePrefix = "builtin:";

/// Box in the scene that the maps of built-in bundles show, metres. Its sides are parallel to the axes.
struct GivenBody {
    glm::dvec3 lo{0}, hi{0};
};
/// Scene that maps of built-in bundles show: a square floor at y = 0 about the origin, and bodies above it.
inline constexpr double kGivenFloorSide = 10;
inline constexpr std::array kGivenBodies = {GivenBody{{-0.75, 0.25, -1}, {0.75, 1.25, 1}},
                                            GivenBody{{-3, 0.5, 1}, {-2, 2, 1.75}}};
/// Place of that scene where its engine draws relative to the camera, world.
inline constexpr glm::dvec3 kGivenFarPlace{4194304, -2097152, 4194304};

/// Light of a built-in bundle: a sun (parallel rays) or a spot light.
struct GivenLight {
    double azimuth_deg = 0, elevation_deg = 0;  ///< as light.azimuth and light.elevation
    double distance = 0;                        ///< of a spot light from the middle of the scene's bounds, metres
    double cone_deg = 0;                        ///< full angle of a spot light; 0: parallel rays
};
/// Sun of the bundles of parallel rays.
inline constexpr GivenLight kGivenSun{30, 40};
/// Lamp of the bundles of a spot light.
inline constexpr GivenLight kGivenSpot{30, 70, 12, 60};

/// Returns true for a name with the prefix of built-in bundles ("builtin:"), which is no path of a file. A bundle of
/// this name need not exist.
bool is_builtin_bundle(const std::filesystem::path& path);

/// Returns the files of a bundle that the program computes itself, for hard cases about imported maps. Depths are those
/// of rays through the texels' centres, computed in double precision.
/// @throws Error for a name that no built-in bundle has
BundleContents builtin_bundle(std::string_view name);

}  // namespace si
