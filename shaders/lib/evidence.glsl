// A pixel's shadow test again with one thing changed at a time, and what else its cause depends on. Needs
// lib/surface.glsl, lib/visibility.glsl and lib/truth.glsl; decided upon by lib/cause.glsl and renderer/frame/causes.h.
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

// Looks with the chosen kernel. In paged maps they are noted first and taken in one loop: compilers for CPUs take minutes
// over so many copies of a kernel that has loops there. Elsewhere copies are several times faster.
#define MOST_LOOKS 10
#define OFFSET 1.0
#define UNFILTERED 2.0
vec3 looks[MOST_LOOKS];  // depth bias; OFFSET and UNFILTERED added up; what beyond_answer is
float trial_results[MOST_LOOKS];
int look_count = 0;

float taken(Receiver r, vec3 how) {
    map_is_unfiltered = how.y >= UNFILTERED;
    beyond_answer = how.z;
    float lit = look(r, mod(how.y, 2.0) == OFFSET, how.x);
    map_is_unfiltered = false;
    beyond_answer = -1.0;
    return lit;
}

/// Which of looked[] it is, once all are taken.
int note_look(Receiver r, float depth_bias, float how, float beyond) {
    looks[look_count] = vec3(depth_bias, how, beyond);
#if !MAP_PAGED
    trial_results[look_count] = taken(r, looks[look_count]);
#endif
    return look_count++;
}

#if MAP_PAGED
/// Of a loop that looks: 0 is added, which compilers do not know, else they would write the loop out.
int kept_loop(int times) { return times + int(frame_pixel().w); }
void take_looks(Receiver r) {
    for (int i = 0; i < kept_loop(look_count); ++i) trial_results[i] = taken(r, looks[i]);
}
#else
#define kept_loop(times) (times)
#define take_looks(r)
#endif

/// Depth from the receiver to a surface that lies so many metres before it along its ray; 0 for none.
float depth_of_gap(Receiver r, float metres) {
    if (metres < 0.0) return 0.0;
    return depth_nearer(r, r.z, metres * axis_per_ray(r));
}

/// @param v visibility as drawn, which stands for trials that the settings make no difference to
Evidence gather_evidence(Receiver r, float v, vec4 reference, vec4 more) {
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
    e.worth = equivalent_depth_bias(r, gradient);
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
    e.gap_drawn = depth_of_gap(r, reference.y);
    e.gap_all = depth_of_gap(r, more.x);
    e.run_m = more.w, e.edge_m = more.z;

    const float as_drawn = -1.0;
    const float bare_map = RASTER_BIAS == 1 ? UNFILTERED : 0.0;
#if SEAM_TRIALS
    int beyond_lit = note_look(r, e.own, OFFSET, 1.0), beyond_dark = note_look(r, e.own, OFFSET, 0.0);
#endif
#if BIAS_NORMAL_OFFSET
    int least_bare = note_look(r, e.least, bare_map, as_drawn);
#endif
#if FOR_FALSE_LIGHT
    int least_kept = note_look(r, max(e.least - e.offset, 0.0), OFFSET + bare_map, as_drawn);
#if BIAS_NORMAL_OFFSET
    int own_bare = note_look(r, max(e.own, e.least), 0.0, as_drawn), far_bare = note_look(r, e.far, 0.0, as_drawn);
#endif
#endif
#if FOR_FALSE_SHADOW
    int raised = note_look(r, e.own + max(e.least - e.worth, 0.0), OFFSET, as_drawn);
    int bent_raised = note_look(r, e.own + max(e.bent - e.worth, 0.0), OFFSET, as_drawn);
    int most_raised = note_look(r, e.own + max(e.most - e.worth, 0.0), OFFSET, as_drawn);
#endif
#if UNFILTERED_DIFFERS
    int unfiltered = note_look(r, e.own, OFFSET + UNFILTERED, as_drawn);
#endif
    take_looks(r);

    e.beyond_lit = e.beyond_dark = v;
    e.least_kept = e.least_bare = e.own_bare = e.far_bare = e.nearest_bare = e.nearest_own_bare = e.unfiltered = v;
    e.raised = e.bent_raised = e.most_raised = v;
    e.nearest_kept = look_nearest(r, true, max(e.least_nearest - e.offset, 0.0));
#if SEAM_TRIALS
    e.beyond_lit = trial_results[beyond_lit], e.beyond_dark = trial_results[beyond_dark];
#endif
#if BIAS_NORMAL_OFFSET
    e.least_bare = trial_results[least_bare];
    e.nearest_bare = look_nearest(r, false, e.least_nearest);
#endif
#if FOR_FALSE_LIGHT
    e.least_kept = trial_results[least_kept];
#if BIAS_NORMAL_OFFSET
    e.own_bare = trial_results[own_bare], e.far_bare = trial_results[far_bare];
    e.nearest_own_bare = look_nearest(r, false, max(e.own, e.least_nearest));
#endif
#endif
#if FOR_FALSE_SHADOW
    e.raised = trial_results[raised], e.bent_raised = trial_results[bent_raised], e.most_raised = trial_results[most_raised];
#endif
#if UNFILTERED_DIFFERS
    e.unfiltered = trial_results[unfiltered];
#endif
    return e;
}
