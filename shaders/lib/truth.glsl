// The ray-traced truth about the shown light (renderer/reference/truth_picture.h), and what was made of it.
layout(binding = 7) uniform sampler2D truth_map;   // rows from the top: R, metres to the surface nearest the light, state, -
layout(binding = 8) uniform sampler2D edge_map;    // rows from the top: texels to the nearest true edge, texels searched
layout(binding = 9) uniform sampler2D judged_map;  // rows from the bottom: see passes/judge.frag.glsl

const float COUNTED = 0.0;  // PixelState::Counted
const int FALSE_SHADOW = 1, FALSE_LIGHT = 2, OUTSIDE = 4, NEAR_EDGE = 8, UNDECIDED = 16, ANY_ACNE = 32, COUNTS = 64;

/// The truth's pixel that stands for a pixel of the picture.
ivec2 truth_pixel(ivec2 at) { return ivec2(at.x, TRUTH_ROWS - 1 - at.y) / TRUTH_STEP; }
/// The pixel of the picture at which the truth was traced for this one.
ivec2 traced_pixel(ivec2 at) {
    ivec2 p = truth_pixel(at) * TRUTH_STEP;
    return ivec2(p.x, TRUTH_ROWS - 1 - p.y);
}

vec4 truth_at(ivec2 at) { return texelFetch(truth_map, truth_pixel(at), 0); }
vec4 truth_here() { return truth_at(ivec2(gl_FragCoord.xy)); }
float true_visibility(vec4 truth) { return truth.x; }
bool counts(vec4 truth) { return truth.z == COUNTED; }
/// What judge.frag.glsl found for the pixel that stands for this one.
vec4 judged_here() { return texelFetch(judged_map, traced_pixel(ivec2(gl_FragCoord.xy)), 0); }
