// Moments of a kernel (moments_of() in its file), averaged along one axis. The first pass reads the map's depths or all
// samples of each texel, and the second pass the result of the first. Near the map's sides windows shrink on both sides,
// so that the mean over a plane stays the depth at the window's middle.
#include "shared/units.h"
#include "lib/visibility.glsl"
#include "lib/moments.glsl"
#include "lib/blur_axis.glsl"
#if MOMENTS_AS_SUMS && filter_sums == filter_sums_integer
layout(location = 0) out uvec2 moments_out;
#else
layout(location = 0) out vec4 moments_out;
#endif
uniform int layer;
uniform vec4 curve;  // near, far, 1 perspective

#if MOMENTS_FROM == MOMENTS_FROM_MOMENTS
layout(binding = UNIT_BLURRED_ROWS) uniform sampler2D rows;
vec4 moments_at(ivec2 at) { return texelFetch(rows, at, 0); }
#elif MOMENTS_FROM == MOMENTS_FROM_SAMPLES
layout(binding = UNIT_MAP_SAMPLES) uniform sampler2DMS samples_map;
vec4 moments_at(ivec2 at) {
    int count = textureSamples(samples_map);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < count; ++i)
        sum += moments_of(stored_share(texelFetch(samples_map, at, i).r, curve.x, curve.y, curve.z > 0.5)) / float(count);
    return sum;
}
#else
vec4 moments_at(ivec2 at) { return moments_of(stored_share(stored_texel(at, layer), curve.x, curve.y, curve.z > 0.5)); }
#endif

float weight_of(int step) {
#if filter_blur_shape == filter_blur_shape_gaussian
    float deviations = 2.0 * float(step) / float(max(radius, 1));  // two at the last texel
    return exp(-0.5 * deviations * deviations);
#else
    return 1.0;
#endif
}

void main() {
    ivec2 centre = ivec2(gl_FragCoord.xy);
#if BLUR_WINDOW_IS_WHOLE
    const int reach = radius;
#else
    ivec2 window = blur_window(centre);
    int reach = min(-window.x, window.y);
#endif
    float weights = 0.0;
    for (int i = -radius; i <= radius; ++i) weights += abs(i) <= reach ? weight_of(i) : 0.0;
    vec4 mean = vec4(0.0);
    // Each term is weighted before the sum, which would else overflow for large exponentials.
    for (int i = -radius; i <= radius; ++i) {
        vec4 share = moments_at(centre + clamp(i, -reach, reach) * BLUR_AXIS) * (weight_of(i) / weights);
        mean += abs(i) <= reach ? share : vec4(0.0);
    }
#if MOMENTS_AS_SUMS && filter_sums == filter_sums_integer
    moments_out = uvec2(round(mean.rg * SUMS_ONE));
#elif MOMENTS_QUANTISED && MOMENTS_LAST
    moments_out = quantised(mean);
#else
    moments_out = mean;
#endif
}
