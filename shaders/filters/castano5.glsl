// Bilinear comparisons with the weights 1 3 4 3 1 along each axis. Between texels the weights change linearly.
// Castano, Shadow Mapping Summary, on the shadows of The Witness, 2013.
float weight_of(float off) {
    float away = abs(off);
    return max(max(min(4.0 - away, 5.0 - 2.0 * away), 3.0 - away), 0.0);
}

#include "lib/paired_taps.glsl"

float filter_visibility(Receiver r) { return paired_visibility(r); }
