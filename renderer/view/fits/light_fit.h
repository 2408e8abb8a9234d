// Placement of lights and fitting of their shadow maps. CPU, double precision, no GL.
#pragma once

#include <optional>
#include <vector>

#include "renderer/projection/depth_span.h"
#include "renderer/scene/scene.h"
#include "renderer/view/lights/light.h"

namespace si {

struct Camera;

/// Returns true when shading may skip a light: no surface receives light from it, and the composition does not show its
/// visibility alone.
bool adds_no_light(const FittedLight& light, const Settings& settings);

/// Returns true when every look-up in a light's shadow maps would return 1 (lit): the maps hold no caster, and no
/// setting darkens points outside the maps. Shaders then skip the look-ups.
bool is_always_lit(const FittedLight& light, const Settings& settings);

/// Places the lights of the settings in the scene, without maps. Spot and point intensities fall with the square of the
/// distance; they are scaled together so that the brightest contributes 1 at the scene's centre.
PlacedLights place_lights(const Scene& scene, const Settings& settings);

/// Returns the margin in texels around the region that a fit narrows a map to: kernel reach, normal offset and two
/// texels more. The margin grows in steps of 1/64 of the map, so that most kernels and resolutions share a region, and
/// a traced reference serves all of them. The normal offset counts at least with its default.
/// @param resolution texels a side of the map
double fit_margin_texels(const Settings& settings, int resolution);

/// Computes the shadow map views of every placed light. A pure function.
/// @param scene the scene that the lights were placed in
/// @param camera camera of the picture; null: fits that depend on a camera cover the whole scene
/// @param max_resolution the GL limit on texture size
/// @param picture_lines height of the picture in pixels, for clip levels
/// @param seen_m camera depths of all visible surfaces, as measured for light.depth_bounds sdsm
std::vector<FittedLight> fit_maps(const PlacedLights& placed, const Scene& scene, const Settings& settings,
                                  const Camera* camera, int max_resolution = 16384,
                                  const std::optional<DepthSpan>& seen_m = std::nullopt, int picture_lines = 720);

/// Places the lights and computes their shadow map views: place_lights() followed by fit_maps().
std::vector<FittedLight> fit_lights(const Scene& scene, const Settings& settings, const Camera* camera = nullptr);

}  // namespace si
