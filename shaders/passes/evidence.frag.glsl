// Results of all trials of every pixel, right or wrong, in the order of CauseEvidence (renderer/frame/causes.h).
#include "lib/surface.glsl"
#include "lib/visibility.glsl"
#include "lib/truth.glsl"
#include "lib/evidence.glsl"

layout(location = 0) out vec4 out_0;
layout(location = 1) out vec4 out_1;
layout(location = 2) out vec4 out_2;
layout(location = 3) out vec4 out_3;
layout(location = 4) out vec4 out_4;
layout(location = 5) out vec4 out_5;
layout(location = 6) out vec4 out_6;
layout(location = 7) out vec4 out_7;

/// Returns the least equivalent depth bias at which the pixel is lit, at most Evidence::bent.
float curing_bias(Receiver r, Evidence e) {
    float lo = e.equivalent_bias, hi = max(e.bent, e.equivalent_bias);
    for (int i = 0; i < opaque_count(12); ++i) {
        float middle = 0.5 * (lo + hi);
        if (trial_visibility(r, true, e.own + middle - e.equivalent_bias) >= 0.5)
            hi = middle;
        else
            lo = middle;
    }
    return hi;
}

void main() {
    discard_masked();
    Surface s = make_surface();
    Receiver r = make_receiver(s, LIGHT_INDEX);
    float v = light_visibility(s, LIGHT_INDEX);
    if (isnan(v)) v = 0.0;
#if REFERENCE_KNOWN
    vec4 reference = reference_here(), more = more_reference_here();
#else
    vec4 reference = vec4(0.0, -1.0, 0.0, 0.0), more = vec4(-1.0, 0.0, 3e38, 3e38);
#endif
    Evidence e = gather_evidence(r, v, reference, more);
    out_0 = vec4(float(place_in_map(r)), v, e.beyond_lit, e.beyond_dark);
    out_1 = vec4(e.least, e.least_nearest, e.equivalent_bias, e.applied);
    out_2 = vec4(e.slack, e.own, e.offset, e.texel_m);
    out_3 = vec4(e.bent, e.far, e.strip_bias_m, e.strip_offset_m);
    out_4 = vec4(e.least_kept, e.least_bare, e.own_bare, e.far_bare);
    out_5 = vec4(e.raised, e.bent_raised, e.nearest_kept, e.nearest_bare);
#if HAS_CONTACTS
    float by_map = map_visibility(r);
#else
    float by_map = v;
#endif
    out_6 = vec4(e.nearest_own_bare, e.unfiltered, curing_bias(r, e), by_map);
    out_7 = vec4(e.gap_drawn, e.gap_all, e.run_m, e.edge_m);
}
