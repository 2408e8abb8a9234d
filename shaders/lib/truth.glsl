// The ray-traced truth about the shown light (renderer/reference/reference_picture.h), and what was made of it.
#include "shared/units.h"
#include "shared/classified.h"

layout(binding = UNIT_REFERENCE) uniform sampler2D reference_map;   // rows from the top: R, metres to the drawn surface nearest the light, state, noise
layout(binding = UNIT_MORE_REFERENCE) uniform sampler2D more_map;    // rows from the top: metres to the nearest of all casters, hard R, edge_m, run_m
layout(binding = UNIT_CLASSIFIED) uniform sampler2D classified_map;  // rows from the bottom: see judgement()

const float COUNTED = 0.0;  // PixelState::Counted
const float RIGHT_VISIBILITY = 1e-3;

/// The truth's pixel that stands for a pixel of the picture.
ivec2 reference_pixel(ivec2 at) { return ivec2(at.x, REFERENCE_ROWS - 1 - at.y) / REFERENCE_STEP; }
/// The pixel of the picture at which the truth was traced for this one.
ivec2 traced_pixel(ivec2 at) {
    ivec2 p = reference_pixel(at) * REFERENCE_STEP;
    return ivec2(p.x, REFERENCE_ROWS - 1 - p.y);
}

vec4 reference_at(ivec2 at) { return texelFetch(reference_map, reference_pixel(at), 0); }
vec4 reference_here() { return reference_at(ivec2(gl_FragCoord.xy)); }
vec4 more_reference_here() { return texelFetch(more_map, reference_pixel(ivec2(gl_FragCoord.xy)), 0); }
float true_visibility(vec4 reference) { return reference.x; }
float hard_visibility(vec4 more) { return more.y; }
bool counts(vec4 reference) { return reference.z == COUNTED; }

/// What is stored of a pixel.
vec2 classification(int artefact, int bits, float v) { return vec2(float(artefact | bits << ARTEFACT_BITS), v); }
int classified_artefact(vec4 classified) { return int(classified.x) & ((1 << ARTEFACT_BITS) - 1); }
int classified_bits(vec4 classified) { return int(classified.x) >> ARTEFACT_BITS; }
float classified_visibility(vec4 classified) { return classified.y; }

/// How the visibility v compares with the truth. Wrong: on the other side of one half, by more than the truth's noise can
/// explain. Faint: darker than wholly lit, and not wrong.
int compared_bits(float v, vec4 reference, bool outside) {
    float true_v = true_visibility(reference);
    bool sides = (v < 0.5) != (true_v < 0.5), sure = abs(v - true_v) > 3.0 * reference.w;
    bool faint = true_v == 1.0 && v >= 0.5 && v < 1.0 - RIGHT_VISIBILITY;
    return COUNTS + int(sides && sure && v < 0.5) * FALSE_SHADOW + int(sides && sure && v >= 0.5) * FALSE_LIGHT +
           int(sides && !sure) * WITHIN_NOISE + int(faint) * FAINT + int(outside) * OUTSIDE;
}

/// What the passes found for the pixel that stands for this one.
vec4 classified_here() { return texelFetch(classified_map, traced_pixel(ivec2(gl_FragCoord.xy)), 0); }
