// A tent of weights, KERNEL_SIZE texels wide: each texel weighs the part of the tent that stands above it.
// Castano, Shadow Mapping Summary, on the shadows of The Witness, 2013.

/// Of the tent's area what lies to the left of `off`.
float tent_below(float off) {
    float x = clamp(off / (0.5 * float(KERNEL_SIZE)), -1.0, 1.0);
    return 0.5 + x - 0.5 * x * abs(x);
}

float weight_of(float off) { return max(tent_below(off + 0.5) - tent_below(off - 0.5), 0.0); }

#include "lib/paired_taps.glsl"

float filter_visibility(Receiver r) { return paired_visibility(r); }
