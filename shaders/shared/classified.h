// Classification of each pixel compared with the ray-traced reference, shared by C++ and GLSL.
#ifndef SI_SHARED_CLASSIFIED_H
#define SI_SHARED_CLASSIFIED_H

#ifdef __cplusplus
namespace si::shared {
#endif

// Bits of a pixel's classification; meaning in renderer/reference/metrics.h.
const int FALSE_SHADOW = 1, FALSE_LIGHT = 2, OUTSIDE = 4, ANY_ACNE = 8;
const int WITHIN_NOISE = 16, FAINT = 32, COUNTS = 64, SEAM = 128;
// Errors of visibility above this are seen: light in full shadow, acne of a lit surface.
const float VISIBLE_ERROR = 0.02;
// First bit of further causes, bits 1 << artefact.
const int ALSO_SHIFT = 8;
// Bits for the artefact. The classification bits are above, in one number that fits single precision.
const int ARTEFACT_BITS = 4;

// Depth values that select each kind of pixel by the depth test.
const float MARK_FALSE_LIGHT = 0.25, MARK_FALSE_SHADOW = 0.5, MARK_FAINT = 0.75, MARK_NONE = 1.0;

// Place of a surface relative to the map. OFFSET_OUTSIDE: only the normal offset leaves the map.
const int PLACE_INSIDE = 0, PLACE_OUTSIDE = 1, PLACE_OFFSET_OUTSIDE = 2;

// Layers of the sums over tiles, four numbers each. Wrong pixels have one number for each artefact.
const int TILE_DARK = 0, TILE_BRIGHT = 3, TILE_NOTED = 6, TILE_SUMS = 7, TILE_LAYERS = 8;
const int ARTEFACT_LAYERS = 3;

#ifdef __cplusplus
}  // namespace si::shared
#endif
#endif
