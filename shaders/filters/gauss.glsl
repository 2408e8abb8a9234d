// Gaussian weights over KERNEL_SIZE texels, lowered so that they reach 0 at the kernel's ends.
// Pettineo, A Sampling of Shadow Techniques, 2013.
float weight_of(float off) {
    const float end = 0.5 * float(KERNEL_SIZE + 1), deviation = 0.4 * end;
    float scaled = off / deviation, last = end / deviation;
    return max(exp(-0.5 * scaled * scaled) - exp(-0.5 * last * last), 0.0);
}

#include "lib/paired_taps.glsl"

float filter_visibility(Receiver r) { return paired_visibility(r); }
