// A pixel's shadow test again with one thing changed at a time, and what else its cause depends on. Needs
// lib/surface.glsl, lib/visibility.glsl and lib/truth.glsl; decided upon by lib/cause.glsl and renderer/reference/causes.h.
#include "lib/least_bias.glsl"
#include "lib/bias_along_ray.glsl"

#ifndef FOR_FALSE_LIGHT
#define FOR_FALSE_LIGHT 1
#endif
#ifndef FOR_FALSE_SHADOW
#define FOR_FALSE_SHADOW 1
#endif

struct Evidence {
    // Visibility by the chosen kernel with taps beyond the map's sides answered lit, and dark.
    float beyond_lit, beyond_dark;
    // Depths: the least bias of the chosen kernel and of one nearest tap; what all bias is worth; how far it moves the
    // compared depth; what the kernel's reach is worth on the plane; constant or slope bias; the offset's worth.
    float least, least_nearest, worth, applied, slack, own, offset;
    float bent;       // bias of the trial for surfaces that rise beside the plane
    float most;       // `bent` where no true edge is in the kernel's reach, else `least`
    float far;        // bias that only a surface well before this one withstands
    float strip_bias_m, strip_offset_m;  // lit strips that bias and normal offset leave, each by itself
    float texel_m;
    // Visibility by the chosen kernel: least bias; the same without offset; own bias without offset; far without offset;
    // worth raised to the least; to `bent`; to `most`, which no smaller bias can outdo.
    float least_kept, least_bare, own_bare, far_bare, raised, bent_raised, most_raised;
    // By the nearest texel of the unfiltered map: least bias; without offset; without offset, own bias.
    float nearest_kept, nearest_bare, nearest_own_bare;
    float unfiltered; // the chosen kernel and bias on the unfiltered map
    float gap_drawn, gap_all;  // depths from here to the surface nearest the light: as drawn, and of all casters; 0: none
    float run_m, edge_m;       // lib/truth.glsl
};

float look(Receiver r, bool offset, float depth_bias) {
    if (!offset) r.uvd_offset = r.uvd;
    r.reference = r.uvd_offset.z - away(depth_bias);
    return map_visibility(r);
}

float look_nearest(Receiver r, bool offset, float depth_bias) {
    if (!offset) r.uvd_offset = r.uvd;
    if (is_guarded(r)) return guarded_visibility(r);
    map_is_unfiltered = true;
    float lit = depth_test(reference_of(r.uvd_offset.z - away(depth_bias)), map_depth(r.uvd_offset.xy, r.layer));
    map_is_unfiltered = false;
    return lit;
}

float look_unfiltered(Receiver r, bool offset, float depth_bias) {
    map_is_unfiltered = true;
    float lit = look(r, offset, depth_bias);
    map_is_unfiltered = false;
    return lit;
}

/// Depth from the receiver to a surface that lies so many metres before it along its ray; 0 for none.
float depth_of_gap(Receiver r, float metres) {
    if (metres < 0.0) return 0.0;
    return depth_nearer(r, r.z, metres * axis_per_ray(r));
}

/// @param v visibility as drawn, which stands for trials that the settings make no difference to
Evidence gather_evidence(Receiver r, float v, vec4 truth, vec4 more) {
    Evidence e;
    float reach = light_of(r.light).kernel.y;
    vec2 gradient = plane_gradient(r);
    float per_texel = (abs(gradient.x) + abs(gradient.y)) / float(map_resolution);
    e.least = least_bias(r, gradient);
    // Surfaces that rise beside the plane meet the kernel's whole reach, whatever each texel is compared with.
    float whole = least_bias(r, gradient, reach);
    e.least_nearest = least_bias(r, gradient, 0.5);
    e.slack = reach * per_texel;
    e.own = r.bias_depth;
    e.offset = away(r.uvd.z + dot(gradient, r.uvd_offset.xy - r.uvd.xy) - r.uvd_offset.z);
    e.worth = bias_worth(r, gradient);
    float raster = e.worth - e.offset - e.own;
    e.applied = away(r.uvd.z - r.reference) + raster;
    float reach_depth = depth_nearer(r, r.z, reach * r.texel_m);
    e.bent = 2.0 * whole + reach_depth;
    e.most = more.z > (light_of(r.light).kernel.z + 1.0) * r.texel_m ? e.bent : e.least;
    e.far = 2.0 * max(e.own, whole) + reach_depth;
    e.texel_m = r.texel_m;
    float cosine = clamp(r.geometric_n_dot_l, 1e-6, 1.0), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    float offset_m = bias_normal * r.texel_m;
    e.strip_bias_m = max(bias_along_ray_m(r) - offset_m * r.geometric_n_dot_l, 0.0) * sine;
    e.strip_offset_m = offset_m * sine / cosine;
    e.gap_drawn = depth_of_gap(r, truth.y);
    e.gap_all = depth_of_gap(r, more.x);
    e.run_m = more.w, e.edge_m = more.z;

    e.beyond_lit = e.beyond_dark = v;
#if SEAM_TRIALS
    beyond_answer = 1.0;
    e.beyond_lit = look(r, true, e.own);
    beyond_answer = 0.0;
    e.beyond_dark = look(r, true, e.own);
    beyond_answer = -1.0;
#endif

    float kept = max(e.least - e.offset, 0.0);
    e.nearest_kept = look_nearest(r, true, max(e.least_nearest - e.offset, 0.0));
    e.least_kept = e.least_bare = e.own_bare = e.far_bare = e.nearest_bare = e.nearest_own_bare = e.unfiltered = v;
    e.raised = e.bent_raised = e.most_raised = v;
#if BIAS_NORMAL_OFFSET
    e.nearest_bare = look_nearest(r, false, e.least_nearest);
#if RASTER_BIAS
    e.least_bare = look_unfiltered(r, false, e.least);
#else
    e.least_bare = look(r, false, e.least);
#endif
#endif
#if FOR_FALSE_LIGHT
#if RASTER_BIAS
    e.least_kept = look_unfiltered(r, true, kept);
#else
    e.least_kept = look(r, true, kept);
#endif
#if BIAS_NORMAL_OFFSET
    e.own_bare = look(r, false, max(e.own, e.least));
    e.far_bare = look(r, false, e.far);
    e.nearest_own_bare = look_nearest(r, false, max(e.own, e.least_nearest));
#endif
#endif
#if FOR_FALSE_SHADOW
    e.raised = look(r, true, e.own + max(e.least - e.worth, 0.0));
    e.bent_raised = look(r, true, e.own + max(e.bent - e.worth, 0.0));
    e.most_raised = look(r, true, e.own + max(e.most - e.worth, 0.0));
#endif
#if UNFILTERED_DIFFERS
    e.unfiltered = look_unfiltered(r, true, e.own);
#endif
    return e;
}
