// What a frame notes of each pixel that it holds against the truth, for C++ and GLSL alike.
#ifndef SI_SHARED_CLASSIFIED_H
#define SI_SHARED_CLASSIFIED_H

#ifdef __cplusplus
namespace si::shared {
#endif

// Bits; renderer/reference/metrics.h says what they mean.
const int FALSE_SHADOW = 1, FALSE_LIGHT = 2, OUTSIDE = 4, ANY_ACNE = 8;
const int WITHIN_NOISE = 16, FAINT = 32, COUNTS = 64, SEAM = 128;
// What also takes part, as bits 1 << artefact from here on.
const int ALSO_SHIFT = 8;
// The artefact and, above it, the bits are kept as one number, which single precision holds.
const int ARTEFACT_BITS = 4;

// Depths by which each kind of pixel is picked out.
const float MARK_FALSE_LIGHT = 0.25, MARK_FALSE_SHADOW = 0.5, MARK_FAINT = 0.75, MARK_NONE = 1.0;

// Whether the map holds a surface, and if so, whether the normal offset leads the look-up out of it.
const int PLACE_INSIDE = 0, PLACE_OUTSIDE = 1, PLACE_OFFSET_OUTSIDE = 2;

// Layers of the sums over tiles, four numbers each; of wrong pixels one number for each artefact.
const int TILE_DARK = 0, TILE_BRIGHT = 3, TILE_NOTED = 6, TILE_SUMS = 7, TILE_LAYERS = 8;
const int ARTEFACT_LAYERS = 3;

#ifdef __cplusplus
}  // namespace si::shared
#endif
#endif
