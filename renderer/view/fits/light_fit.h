// Where the lights stand and what their shadow maps cover. Pure CPU, double precision, no GL.
#pragma once

#include <optional>
#include <vector>

#include "renderer/projection/depth_span.h"
#include "renderer/scene/scene.h"
#include "renderer/view/lights/light.h"

namespace si {

struct Camera;

/// Whether shading can do without the light: nothing of it arrives, and the composition does not show by its visibility
/// alone what is lit.
bool adds_no_light(const FittedLight& light, const Settings& settings);

/// Whether look-ups of a light's maps answer 1 wherever it shines on what receives: nothing lies in them, and by its
/// place nothing beside or behind them is dark.
bool is_always_lit(const FittedLight& light, const Settings& settings);

/// Spot and point intensities fall with the square of the distance and are scaled together so that the brightest light
/// contributes 1 at the scene's centre.
PlacedLights place_lights(const Scene& scene, const Settings& settings);

/// Texels that a map has on each side of the region that a fit narrows it to: the kernel's reach, the normal offset (at
/// least its default, so that it does not change the map up to there) and two more, in steps of 1/64 of the map:
/// kernels and resolutions are then mostly compared on the same region, and a truth once traced serves all of them.
/// What lies less than one texel from the rim, or beyond, is taken to be lit: no kernel would find anything else there.
double fit_margin_texels(const Settings& settings, int resolution);

/// Gives every placed light the views of its maps. A pure function.
/// @param scene that the lights were placed in
/// @param camera whose picture the maps are for; null: fits that depend on one hold the whole scene instead, as the
///     camera that looks through a light has them
/// @param max_resolution the GL limit on texture size
/// @param picture_lines pixels of the picture's height, which clip levels go by
/// @param seen_m depths of all that the camera sees, where they were measured: what light.depth_bounds sdsm goes by
std::vector<FittedLight> fit_maps(const PlacedLights& placed, const Scene& scene, const Settings& settings,
                                  const Camera* camera, int max_resolution = 16384,
                                  const std::optional<DepthSpan>& seen_m = std::nullopt, int picture_lines = 720);

/// Both at once.
std::vector<FittedLight> fit_lights(const Scene& scene, const Settings& settings, const Camera* camera = nullptr);

}  // namespace si
