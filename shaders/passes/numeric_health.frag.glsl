// Search for invalid numbers in an image (NaN, infinite, out of range). The result for each kind of fault is the count, the
// first place, the worst place and its value. The first pass handles tiles of a layer, the second pass joins the tiles.
#include "shared/units.h"
layout(location = 0) out uvec4 faults_out[HEALTH_FAULTS];  // count, first and worst as x | y << 16, bits of the worst

const uint NOWHERE = 0xffffffffu;

/// Returns the severity of a fault, for comparison with others of its kind.
float amount_of(int fault, float value) {
    return fault == FAULT_OUTSIDE_RANGE ? max(-value, value - 1.0) : fault == FAULT_NEGATIVE_VARIANCE ? -value : 0.0;
}

uint place_of(ivec2 at) { return uint(at.x) | uint(at.y) << 16; }

/// Merges the faults `more` into `sum`, which comes before in reading order.
void add(inout uvec4 sum, uvec4 more, int fault) {
    if (more.x == 0u) return;
    // Equal faults are ordered by place, rows first, since y is the upper half of a place.
    bool worse = sum.x == 0u || amount_of(fault, uintBitsToFloat(more.w)) > amount_of(fault, uintBitsToFloat(sum.w)) ||
                 (amount_of(fault, uintBitsToFloat(more.w)) == amount_of(fault, uintBitsToFloat(sum.w)) && more.z < sum.z);
    sum.x += more.x;
    sum.y = min(sum.y, more.y);
    if (worse) sum.zw = more.zw;
}

#if HEALTH_STEP == 0
#if HEALTH_LAYERS > 0
layout(binding = UNIT_SEARCHED) uniform sampler2DArray searched;
#define SEARCHED_TEXEL(at) texelFetch(searched, ivec3(at, layer), level)
#else
layout(binding = UNIT_SEARCHED) uniform sampler2D searched;
#define SEARCHED_TEXEL(at) texelFetch(searched, at, level)
#endif
uniform int layer, level;
uniform ivec2 size;    // texels of the level
uniform int tile;      // texels along a tile's side
uniform int from_top;  // rows count from the top
uniform vec2 slack;    // rounding tolerance: relative to a mean square, and absolute

#if HEALTH_QUANTISED
#include "shared/moments.h"
vec4 numbers_at(ivec2 at) {
    return mat4(MOMENTS_RESTORE) * (SEARCHED_TEXEL(at) - vec4(MOMENTS_QUANTISE_OFFSET, 0.0, 0.0, 0.0));
}
#else
vec4 numbers_at(ivec2 at) { return SEARCHED_TEXEL(at); }
#endif

// Tests of bits, since a compiler may assume that floats are numbers.
bool is_nan(float v) { return (floatBitsToUint(v) & 0x7fffffffu) > 0x7f800000u; }
bool is_infinite(float v) { return (floatBitsToUint(v) & 0x7fffffffu) == 0x7f800000u; }

void find(inout uvec4 found[HEALTH_FAULTS], int fault, float value, ivec2 at) {
    uint place = place_of(at);
    add(found[fault], uvec4(1u, place, place, floatBitsToUint(value)), fault);
}

/// Records a negative variance of a mean and a mean square. Returns true when there is one.
bool find_variance(inout uvec4 found[HEALTH_FAULTS], vec2 moments, ivec2 at) {
    float variance = moments.y - moments.x * moments.x;
    if (!(variance < -(slack.x * moments.y + slack.y))) return false;
    find(found, FAULT_NEGATIVE_VARIANCE, variance, at);
    return true;
}

void search(inout uvec4 found[HEALTH_FAULTS], ivec2 at) {
    vec4 numbers = numbers_at(at);
    if (from_top != 0) at.y = size.y - 1 - at.y;
    for (int i = 0; i < HEALTH_CHANNELS; ++i) {
        if (is_nan(numbers[i])) {
            find(found, FAULT_NOT_A_NUMBER, numbers[i], at);
            return;
        }
#if HEALTH_WARPED
        // An exponential is never 0, so 0 means underflow.
        if (is_infinite(numbers[i]) || numbers[i] == 0.0) {
            find(found, FAULT_OVERFLOW, numbers[i], at);
            return;
        }
#endif
        if (is_infinite(numbers[i])) {
            find(found, FAULT_INFINITE, numbers[i], at);
            return;
        }
    }
#if HEALTH_IN_RANGE
    if (numbers.x < -slack.y || numbers.x > 1.0 + slack.y) find(found, FAULT_OUTSIDE_RANGE, numbers.x, at);
#endif
#if HEALTH_VARIANCES > 0
    if (find_variance(found, numbers.xy, at)) return;
#endif
#if HEALTH_VARIANCES > 1
    find_variance(found, numbers.zw, at);
#endif
}

void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * tile, end = min(corner + tile, size);
    for (int i = 0; i < HEALTH_FAULTS; ++i) faults_out[i] = uvec4(0u, NOWHERE, NOWHERE, 0u);
    uvec4 found[HEALTH_FAULTS] = faults_out;
    for (int y = corner.y; y < end.y; ++y)
        for (int x = corner.x; x < end.x; ++x) search(found, ivec2(x, y));
    for (int i = 0; i < HEALTH_FAULTS; ++i) faults_out[i] = found[i];
}
#else
layout(binding = UNIT_SEARCHED) uniform usampler2DArray tiles;
uniform ivec2 size;  // in tiles

void main() {
    for (int i = 0; i < HEALTH_FAULTS; ++i) {
        uvec4 sum = uvec4(0u, NOWHERE, NOWHERE, 0u);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) add(sum, texelFetch(tiles, ivec3(x, y, i), 0), i);
        faults_out[i] = sum;
    }
}
#endif
