// One step of a summed-area table along one axis: joins up to eight sums of neighbouring runs of `run` texels into one sum
// of eight times the length. Hensley and others, Fast Summed-Area Table Generation, Eurographics 2005.
#include "shared/units.h"
#include "lib/blur_axis.glsl"
uniform int run;
#if filter_sums == filter_sums_integer
layout(binding = UNIT_BLURRED_ROWS) uniform usampler2D sums;
layout(location = 0) out uvec2 sum_out;
#define SUM_OF uvec2
#else
layout(binding = UNIT_BLURRED_ROWS) uniform sampler2D sums;
layout(location = 0) out vec2 sum_out;
#define SUM_OF vec2
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    SUM_OF sum = SUM_OF(0);
    for (int i = 0; i < 8 && all(greaterThanEqual(at, ivec2(0))); ++i, at -= run * BLUR_AXIS)
        sum += texelFetch(sums, at, 0).rg;
    sum_out = sum;
}
