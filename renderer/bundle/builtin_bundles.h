// Bundles that the program makes itself: maps of an engine for the hard cases about imported maps.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <string_view>

#include "renderer/bundle/bundle_contents.h"

namespace si {

/// Prefix of the name of a bundle that the program computes itself. The setting map.bundle takes such a name:
/// "builtin:strip".
inline constexpr std::string_view kBuiltinBundlePrefix = "builtin:";

/// Axis-aligned box in the scene that the shadow maps of built-in bundles (engine frames made by this program) show,
/// metres.
struct GivenBody {
    glm::dvec3 lo{0}, hi{0};
};
/// Side of the square floor in the scene that the shadow maps of built-in bundles show, metres. The floor is centred on
/// the origin, at y = 0.
inline constexpr double kGivenFloorSide = 10;
/// Boxes above the floor in the scene that the shadow maps of built-in bundles show.
inline constexpr std::array kGivenBodies = {GivenBody{{-0.75, 0.25, -1}, {0.75, 1.25, 1}},
                                            GivenBody{{-3, 0.5, 1}, {-2, 2, 1.75}}};
/// World position of the scene in the two built-in bundles (engine frames made by this program) that lie far from the
/// origin: "relative-to-camera" and "absolute". Metres.
inline constexpr glm::dvec3 kGivenFarPlace{4194304, -2097152, 4194304};

/// Light of a built-in bundle (an engine frame made by this program): a sun (parallel rays) or a spot light.
struct GivenLight {
    double azimuth_deg = 0, elevation_deg = 0;  ///< as in the settings light.azimuth and light.elevation
    double distance = 0;                        ///< metres from a spot light to the middle of the scene's bounds
    double cone_deg = 0;                        ///< full angle of a spot light; 0: parallel rays
};
/// Directional light of the built-in bundles whose maps have parallel rays.
inline constexpr GivenLight kGivenSun{30, 40};
/// Spot light of the built-in bundles whose maps are perspective.
inline constexpr GivenLight kGivenSpot{30, 70, 12, 60};

/// Returns true when a path begins with "builtin:", and so names a built-in bundle instead of a file. Does not check
/// that the bundle exists.
bool is_builtin_bundle(const std::filesystem::path& path);

/// Returns the files of a bundle (an engine's frame) that the program computes itself. Hard cases (situations in which
/// shadow maps break) use these bundles as imported maps. Depths are those of rays through the texels' centres,
/// computed in double precision.
/// @param name name with its prefix: "builtin:strip"
/// @throws Error for a name that no built-in bundle has
BundleContents builtin_bundle(std::string_view name);

}  // namespace si
