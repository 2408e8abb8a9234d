// What the settings' bias is worth against acne, and what the chosen kernel needs: renderer/bias/account.h in single
// precision. Depths are in depth-buffer units; texels_nearer() makes texels of them.
#include "biases/raster.glsl"

/// Of the chosen kernel.
float least_bias(Receiver r, vec2 gradient) {
#if BIAS_PER_TEXEL
    float kernel = light_of(r.light).kernel.y * (abs(gradient.x) + abs(gradient.y)) / float(map_resolution);
    return max(kernel - max_texel_shift(r), 0.0) + least_bias_per_texel(r, gradient);
#else
    return least_bias(r, gradient, light_of(r.light).kernel.y);
#endif
}

/// How far all bias brings the compared depth before the receiver's own plane.
float equivalent_depth_bias(Receiver r, vec2 gradient) {
    float plane = r.uvd.z + dot(gradient, r.uvd_offset.xy - r.uvd.xy);
    return away(plane - r.reference) + raster_offset(abs(gradient) / float(map_resolution), depth_quantum(r));
}
