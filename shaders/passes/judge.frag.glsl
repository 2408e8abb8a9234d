// Each pixel's visibility held against the truth: the GPU's side of renderer/reference/metrics.cpp.
#include "lib/surface.glsl"
#include "lib/bias_along_ray.glsl"
#include "lib/truth.glsl"
layout(binding = 3) uniform sampler2DArray visibility_map;

layout(location = 0) out vec4 judged_out;  // artefact, V - R, bits as in lib/truth.glsl, V

const float RIGHT_VISIBILITY = 1e-3;
const float REACH = EDGE_REACH_TEXELS;  // of the kernel, and one more

void main() {
#ifdef MASKED
    if (masked_out()) discard;
#endif
    vec4 truth = truth_here();
    if (!counts(truth)) {
        judged_out = vec4(0.0);
        return;
    }
    Receiver r = make_receiver(make_surface(), LIGHT_INDEX);
    float v = texelFetch(visibility_map, ivec3(gl_FragCoord.xy, LIGHT_INDEX), 0).r, true_v = true_visibility(truth);
    if (isnan(v)) v = 0.0;
    vec2 edge = texelFetch(edge_map, truth_pixel(ivec2(gl_FragCoord.xy)), 0).xy;
    bool outside = r.where != INSIDE && r.where != NO_MAP;
    bool differs = abs(v - true_v) > RIGHT_VISIBILITY;
    bool penumbra = true_v > 0.0 && true_v < 1.0;
    bool found = edge.x <= REACH, searched = found || edge.y >= REACH;
    bool undecided = differs && !outside && !penumbra && !searched;
    bool near_edge = penumbra || (differs && found);
    bool false_shadow = true_v >= 0.5 && v < 0.5, false_light = true_v < 0.5 && v >= 0.5;
    int artefact = ARTEFACT_NONE;
    if (outside)
        artefact = ARTEFACT_OUTSIDE_MAP;
    else if (false_shadow || false_light) {
        artefact = undecided      ? ARTEFACT_UNDECIDED
                   : near_edge    ? ARTEFACT_EDGE_ALIASING
                   : false_shadow ? ARTEFACT_ACNE
                   : truth.y < 0.0 ? ARTEFACT_LOST_CASTER
                   : bias_along_ray_m(r) >= truth.y ? ARTEFACT_PETER_PANNING
                                                    : ARTEFACT_LEAK;
    }
    bool any_acne = true_v == 1.0 && !outside && !near_edge && !undecided && v < 1.0 - RIGHT_VISIBILITY;
    int bits = COUNTS + int(false_shadow) * FALSE_SHADOW + int(false_light) * FALSE_LIGHT + int(outside) * OUTSIDE +
               int(near_edge) * NEAR_EDGE + int(undecided) * UNDECIDED + int(any_acne) * ANY_ACNE;
    judged_out = vec4(float(artefact), v - true_v, float(bits), v);
}
