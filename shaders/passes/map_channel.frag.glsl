// One moment of the map for the map viewer: the stored number, or the depth whose moment it is.
#include "lib/visibility.glsl"
layout(location = 0) out float channel_out;
uniform int layer, channel, mip;
uniform bool as_share;

#if MOMENTS_SUMMED
// The table stores the sum of all texels up to this one. Differences of the table give the texel's own moment.
float number_at(ivec2 at) {
    ivec2 end = at + 1;
    SUMS sum = sum_before(end, layer);
    if (as_share)
        sum = sum - sum_before(ivec2(at.x, end.y), layer) - sum_before(ivec2(end.x, at.y), layer) + sum_before(at, layer);
    return vec2(sum)[channel] * SUMS_UNIT;
}
#else
float number_at(ivec2 at) {
    return restored(texelFetch(moments_map, TEXEL_IN_LAYER(at, layer), mip))[channel];
}
#endif

void main() {
    float number = number_at(ivec2(gl_FragCoord.xy));
    channel_out = number;
    if (!as_share) return;
    // Every moment is monotonic in depth, so bisection finds the depth.
    bool rises = moments_of(1.0)[channel] > moments_of(0.0)[channel];
    float lo = 0.0, hi = 1.0;
    for (int i = 0; i < 24; ++i) {
        float middle = 0.5 * (lo + hi);
        if ((moments_of(middle)[channel] < number) == rises)
            lo = middle;
        else
            hi = middle;
    }
    channel_out = 0.5 * (lo + hi);
}
