// Placement of lights and fitting of their shadow maps. CPU, double precision, no GL.
#pragma once

#include <optional>
#include <vector>

#include "renderer/projection/depth_span.h"
#include "renderer/scene/scene.h"
#include "renderer/view/lights/light.h"

namespace si {

struct Camera;

/// Returns true when shading may skip a light: no surface receives light from it, and the picture does not show the
/// light's visibility alone (shading.composition).
bool adds_no_light(const FittedLight& light, const Settings& settings);

/// Returns true when every look-up in a light's shadow maps must return 1 (lit), so that shaders may skip it. The maps
/// then contain no caster, points outside them count as lit (map.outside), and bias and kernel cannot make a lit
/// surface dark.
bool is_always_lit(const FittedLight& light, const Settings& settings);

/// Places the lights of the settings in the scene, without shadow maps. Intensities of spot and point lights fall with
/// the square of the distance. They are scaled together so that the brightest contributes 1 at the scene's centre.
PlacedLights place_lights(const Scene& scene, const Settings& settings);

/// Returns the margin in texels that a fit adds around the region that a shadow map has to cover. It is the sum of
/// kernel reach, depth blur (map.blur_texels), normal offset (clamped to 3 to 32 texels) and two texels. The margin
/// grows in steps of 1/64 of the map. Most kernels and resolutions therefore share a region, and one traced reference
/// serves all of them.
/// @param resolution texels along a side of the map
double fit_margin_texels(const Settings& settings, int resolution);

/// Computes the shadow map views of every placed light: what each map covers, by the rule that the setting light.fit
/// names. A pure function.
/// @param scene the scene in which the lights were placed
/// @param camera camera of the picture; null: fits that depend on a camera cover the whole scene
/// @param max_resolution the GL limit on texture size
/// @param seen_m camera depths of all visible surfaces, measured for light.depth_bounds=sdsm; nullopt: not measured
/// @param picture_lines height of the picture in pixels, for clip levels (virtual maps around the camera, each with
/// larger texels than the one before)
std::vector<FittedLight> fit_maps(const PlacedLights& placed, const Scene& scene, const Settings& settings,
                                  const Camera* camera, int max_resolution = 16384,
                                  const std::optional<DepthSpan>& seen_m = std::nullopt, int picture_lines = 720);

/// Places the lights and computes their shadow map views: place_lights() followed by fit_maps().
std::vector<FittedLight> fit_lights(const Scene& scene, const Settings& settings, const Camera* camera = nullptr);

}  // namespace si
