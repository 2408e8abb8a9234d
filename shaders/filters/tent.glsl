// A tent of weights, KERNEL_SIZE texels wide: the weight of a texel is the area of the tent above the texel.
// Castano, Shadow Mapping Summary, on the shadows of The Witness, 2013.

/// Returns the share of the tent's area to the left of `off`, in texels from the middle.
float tent_below(float off) {
    float x = clamp(off / (0.5 * float(KERNEL_SIZE)), -1.0, 1.0);
    return 0.5 + x - 0.5 * x * abs(x);
}

float weight_of(float off) { return max(tent_below(off + 0.5) - tent_below(off - 0.5), 0.0); }

#include "lib/paired_taps.glsl"

float filter_visibility(Receiver r) { return paired_visibility(r); }
