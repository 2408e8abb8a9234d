// Colours of scales and legends, shared by C++ and GLSL.
#ifndef SI_SHARED_COLOURS_H
#define SI_SHARED_COLOURS_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace si::shared {
using glm::vec3;
#endif

// Sequential scale, perceptually ordered from dark blue to yellow, readable with the common colour-vision deficiencies
// and in grey: three stops in the spirit of Nunez, Anderton and Renslow's cividis (PLoS ONE 13(7), 2018).
const vec3 SEQUENTIAL_LOW = vec3(0.00, 0.13, 0.30);
const vec3 SEQUENTIAL_MIDDLE = vec3(0.48, 0.48, 0.47);
const vec3 SEQUENTIAL_HIGH = vec3(0.99, 0.91, 0.27);

// Diverging scale: blue below zero, white at zero, orange above.
const vec3 DIVERGING_LOW = vec3(0.02, 0.28, 0.60);
const vec3 DIVERGING_MIDDLE = vec3(0.96, 0.96, 0.96);
const vec3 DIVERGING_HIGH = vec3(0.80, 0.33, 0.00);

// Depth bands: below view.band_low, up to view.band_high, above.
const vec3 BAND_NEAR = vec3(0.75, 0.15, 0.12);
const vec3 BAND_MIDDLE = vec3(0.20, 0.65, 0.25);
const vec3 BAND_FAR = vec3(0.25, 0.43, 0.89);

// Pages of virtual maps: not requested; cached from earlier frames; drawn for this frame; replaced by a coarser page.
const vec3 PAGE_NOT_THERE = vec3(0.10, 0.13, 0.22), PAGE_IS_CACHED = vec3(0.20, 0.65, 0.25);
const vec3 PAGE_IS_DRAWN = vec3(0.93, 0.55, 0.10), PAGE_IS_COARSER = vec3(0.80, 0.20, 0.55);

// Empty texels of a depth image: stripes, darker than any depth.
const vec3 HATCH_LINE = vec3(0.15, 0.16, 0.18), HATCH_BETWEEN = vec3(0.10, 0.11, 0.13);
const float HATCH_PIXELS = 32.0;

// A light's views, in order: cascades from the camera on, or the faces +x -x +y -y +z -z.
const int VIEW_COLOUR_COUNT = 8;
const vec3 VIEW_COLOURS[VIEW_COLOUR_COUNT] = {vec3(0.25, 0.43, 0.89), vec3(0.20, 0.65, 0.25), vec3(0.93, 0.78, 0.20),
                                              vec3(0.80, 0.25, 0.18), vec3(0.58, 0.35, 0.75), vec3(0.55, 0.55, 0.55),
                                              vec3(0.15, 0.70, 0.75), vec3(0.90, 0.50, 0.70)};

/// Returns the colour of a light's view. Colours repeat for lights with more views than colours.
#ifdef __cplusplus
static inline
#endif
    vec3
    view_colour(int view) {
    return VIEW_COLOURS[view % VIEW_COLOUR_COUNT];
}

#ifdef __cplusplus
}  // namespace si::shared
#endif
#endif
