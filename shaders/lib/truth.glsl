// The ray-traced truth about the shown light (renderer/reference/reference_picture.h), and what was made of it.
#include "shared/units.h"
#include "shared/judged.h"

layout(binding = UNIT_TRUTH) uniform sampler2D truth_map;   // rows from the top: R, metres to the drawn surface nearest the light, state, noise
layout(binding = UNIT_MORE_TRUTH) uniform sampler2D more_map;    // rows from the top: metres to the nearest of all casters, hard R, edge_m, run_m
layout(binding = UNIT_JUDGED) uniform sampler2D judged_map;  // rows from the bottom: see judgement()

const float COUNTED = 0.0;  // PixelState::Counted
const float RIGHT_VISIBILITY = 1e-3;

/// The truth's pixel that stands for a pixel of the picture.
ivec2 truth_pixel(ivec2 at) { return ivec2(at.x, TRUTH_ROWS - 1 - at.y) / TRUTH_STEP; }
/// The pixel of the picture at which the truth was traced for this one.
ivec2 traced_pixel(ivec2 at) {
    ivec2 p = truth_pixel(at) * TRUTH_STEP;
    return ivec2(p.x, TRUTH_ROWS - 1 - p.y);
}

vec4 truth_at(ivec2 at) { return texelFetch(truth_map, truth_pixel(at), 0); }
vec4 truth_here() { return truth_at(ivec2(gl_FragCoord.xy)); }
vec4 more_truth_here() { return texelFetch(more_map, truth_pixel(ivec2(gl_FragCoord.xy)), 0); }
float true_visibility(vec4 truth) { return truth.x; }
float hard_visibility(vec4 more) { return more.y; }
bool counts(vec4 truth) { return truth.z == COUNTED; }

/// What is stored of a pixel.
vec2 judgement(int artefact, int bits, float v) { return vec2(float(artefact | bits << ARTEFACT_BITS), v); }
int judged_artefact(vec4 judged) { return int(judged.x) & ((1 << ARTEFACT_BITS) - 1); }
int judged_bits(vec4 judged) { return int(judged.x) >> ARTEFACT_BITS; }
float judged_visibility(vec4 judged) { return judged.y; }

/// How the visibility v compares with the truth. Wrong: on the other side of one half, by more than the truth's noise can
/// explain. Faint: darker than wholly lit, and not wrong.
int compared_bits(float v, vec4 truth, bool outside) {
    float true_v = true_visibility(truth);
    bool sides = (v < 0.5) != (true_v < 0.5), sure = abs(v - true_v) > 3.0 * truth.w;
    bool faint = true_v == 1.0 && v >= 0.5 && v < 1.0 - RIGHT_VISIBILITY;
    return COUNTS + int(sides && sure && v < 0.5) * FALSE_SHADOW + int(sides && sure && v >= 0.5) * FALSE_LIGHT +
           int(sides && !sure) * WITHIN_NOISE + int(faint) * FAINT + int(outside) * OUTSIDE;
}

/// What the passes found for the pixel that stands for this one.
vec4 judged_here() { return texelFetch(judged_map, traced_pixel(ivec2(gl_FragCoord.xy)), 0); }
