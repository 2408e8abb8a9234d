// Weights 1 2 1 along each axis. With nearest comparisons this is the binomial mask of second order:
// B. Jaehne, Digital Image Processing, chapter on averaging. With bilinear ones the weights are a tent 4 texels across,
// in four comparisons: Castano, Shadow Mapping Summary, on the shadows of The Witness, 2013.
#if SAMPLER_BILINEAR
float weight_of(float off) { return max(2.0 - abs(off), 0.0); }

#include "lib/paired_taps.glsl"

float filter_visibility(Receiver r) { return paired_visibility(r); }
#else
float filter_visibility(Receiver r) {
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec2 at = r.uvd_offset.xy + vec2(x, y) / MAP_SIZE;
            float weight = float((2 - abs(x)) * (2 - abs(y)));
            sum += weight * compares_lit(r, at);
        }
    return sum / 16.0;
}
#endif
