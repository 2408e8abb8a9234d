// Each pixel's visibility held against the truth: which are wrong. Why, passes/causes.frag.glsl finds for those alone.
// Where the map holds all that there is, no surface has to be drawn for that.
#include "lib/truth.glsl"
#if !MAP_HOLDS_ALL
#include "lib/surface.glsl"
#include "lib/visibility.glsl"
#endif
layout(binding = 3) uniform sampler2DArray visibility_map;

layout(location = 0) out vec4 judged_out;  // artefact, V - R, bits as in lib/truth.glsl, V

void main() {
#if defined(MASKED) && !MAP_HOLDS_ALL
    if (masked_out()) discard;
#endif
    vec4 truth = truth_here();
    if (!counts(truth)) {
        judged_out = vec4(0.0);
        return;
    }
#if MAP_HOLDS_ALL
    bool outside = false;
#else
    bool outside = place_in_map(make_receiver(make_surface(), LIGHT_INDEX)) == PLACE_OUTSIDE;
#endif
    float v = texelFetch(visibility_map, ivec3(gl_FragCoord.xy, LIGHT_INDEX), 0).r;
    if (isnan(v)) v = 0.0;
    judged_out = vec4(float(ARTEFACT_NONE), v - true_visibility(truth), float(compared_bits(v, truth, outside)), v);
}
