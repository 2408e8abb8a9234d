// Trials of a pixel: its shadow test repeated with one change at a time, and further facts that decide its cause. Needs
// lib/surface.glsl, lib/visibility.glsl and lib/truth.glsl. lib/cause.glsl and renderer/frame/causes.h decide the cause.
#include "lib/least_bias.glsl"
#include "lib/bias_along_ray.glsl"

#ifndef FOR_FALSE_LIGHT
#define FOR_FALSE_LIGHT 1
#endif
#ifndef FOR_FALSE_SHADOW
#define FOR_FALSE_SHADOW 1
#endif

/// Results of the trials of one pixel; CauseEvidence of renderer/frame/causes.h.
struct Evidence {
    // Visibility by the chosen kernel with taps outside the map taken as lit, as dark.
    float beyond_lit, beyond_dark;
    // Depths: least bias of the chosen kernel, and of one nearest tap; equivalent depth bias of all bias; shift of the
    // compared depth; depth change of the plane over the kernel's reach; constant or slope bias; equivalent depth bias of
    // the normal offset.
    float least, least_nearest, equivalent_bias, applied, slack, own, offset;
    float bent;       // bias of the trial for surfaces that rise next to the plane
    float most;       // `bent` if no true edge is in the kernel's reach, else `least`
    float far;        // bias of the trial for distant casters
    float strip_bias_m, strip_offset_m;  // lit strips left by bias, by normal offset
    float texel_m;
    // Visibility by the chosen kernel: least bias; least bias without offset; own bias without offset; `far` without offset;
    // all bias raised to `least`; to `bent`; to `most`.
    float least_kept, least_bare, own_bare, far_bare, raised, bent_raised, most_raised;
    // Visibility by the nearest texel of the unfiltered map: least bias; least bias without offset; own bias without offset.
    float nearest_kept, nearest_bare, nearest_own_bare;
    float unfiltered; // the chosen kernel and bias on the unfiltered map
    float gap_drawn, gap_all;  // depth up to the surface nearest the light: as drawn, of all casters; 0: none
    float run_m, edge_m;       // lib/truth.glsl
};

/// Returns the visibility by the chosen kernel, with or without normal offset, by another depth bias.
float trial_visibility(Receiver r, bool offset, float depth_bias) {
    if (!offset) r.uvd_offset = r.uvd;
    r.reference = r.uvd_offset.z - away_from_light(depth_bias);
#if BIAS_HAS_REMAINDER
    if (depth_bias < r.bias_depth) r.remainder = 0.0;  // less bias than the settings give: the plane's own
#endif
    return map_visibility(r);
}

/// Returns the visibility by the nearest texel of the unfiltered map.
float nearest_trial_visibility(Receiver r, bool offset, float depth_bias) {
    if (!offset) r.uvd_offset = r.uvd;
    if (is_guarded(r)) return guarded_visibility(r);
    map_is_unfiltered = true;
    float lit = depth_test(reference_of(r.uvd_offset.z - away_from_light(depth_bias)), map_depth(r.uvd_offset.xy, r.layer));
    map_is_unfiltered = false;
    return lit;
}

// Trials with the chosen kernel. For paged maps trials are queued and run in one loop, since compilers for CPUs take minutes
// for so many copies of a kernel with loops. For other maps copies run several times faster.
#define MAX_TRIALS 10
#define OFFSET 1.0
#define UNFILTERED 2.0
vec3 trials[MAX_TRIALS];  // depth bias; sum of OFFSET and UNFILTERED; beyond_answer
float trial_results[MAX_TRIALS];
int trial_count = 0;

/// Returns the visibility of one trial.
float run_trial(Receiver r, vec3 how) {
    map_is_unfiltered = how.y >= UNFILTERED;
    beyond_answer = how.z;
    float lit = trial_visibility(r, mod(how.y, 2.0) == OFFSET, how.x);
    map_is_unfiltered = false;
    beyond_answer = -1.0;
    return lit;
}

/// Queues a trial. Returns its index in trial_results[], valid after run_queued_trials().
int queue_trial(Receiver r, float depth_bias, float how, float beyond) {
    trials[trial_count] = vec3(depth_bias, how, beyond);
#if !MAP_PAGED
    trial_results[trial_count] = run_trial(r, trials[trial_count]);
#endif
    return trial_count++;
}

#if MAP_PAGED
/// Returns the loop count plus a 0 that compilers cannot know, so that they do not unroll the loop.
int opaque_count(int times) { return times + int(frame_pixel().w); }
void run_queued_trials(Receiver r) {
    for (int i = 0; i < opaque_count(trial_count); ++i) trial_results[i] = run_trial(r, trials[i]);
}
#else
#define opaque_count(times) (times)
#define run_queued_trials(r)
#endif

/// Converts a distance before the receiver along the light ray, metres, to depth; 0 for a negative one (no surface).
float depth_of_gap(Receiver r, float metres) {
    if (metres < 0.0) return 0.0;
    return depth_change_towards_light(r, r.z, metres * axis_per_ray(r));
}

/// Runs all trials of a pixel.
/// @param v drawn visibility, used for trials that the settings make superfluous
Evidence gather_evidence(Receiver r, float v, vec4 reference, vec4 more) {
    Evidence e;
    float reach = light_of(r.light).kernel.y;
    vec2 gradient = plane_gradient(r);
    float per_texel = rise_per_texel(gradient, 1.0);
    e.least = least_bias(r, gradient);
    // Surfaces that rise next to the plane need the whole reach of the kernel, also with a compared depth for each texel.
    float whole = least_bias(r, gradient, reach);
    e.least_nearest = least_bias(r, gradient, 0.5);
    e.slack = reach * per_texel;
    e.own = r.bias_depth;
    e.offset = away_from_light(r.uvd.z + dot(gradient, r.uvd_offset.xy - r.uvd.xy) - r.uvd_offset.z);
    e.equivalent_bias = equivalent_depth_bias(r, gradient);
    float raster = e.equivalent_bias - e.offset - e.own;
    e.applied = away_from_light(r.uvd.z - r.reference) + raster;
    float reach_depth = depth_change_towards_light(r, r.z, reach * r.texel_m);
    e.bent = 2.0 * whole + reach_depth;
    e.most = more.z > (light_of(r.light).kernel.z + 1.0) * r.texel_m ? e.bent : e.least;
    e.far = 2.0 * max(e.own, whole) + reach_depth;
    e.texel_m = r.texel_m;
    float cosine = clamp(r.geometric_n_dot_l, 1e-6, 1.0), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    vec3 offset = geometric_offset(r);
    e.strip_bias_m = max(bias_along_ray_m(r) - dot(offset, r.to_light), 0.0) * sine;
    e.strip_offset_m = length(cross(offset, r.to_light)) / cosine;
    e.gap_drawn = depth_of_gap(r, reference.y);
    e.gap_all = depth_of_gap(r, more.x);
    e.run_m = more.w, e.edge_m = more.z;

    const float as_drawn = -1.0;
    const float bare_map = RASTER_BIAS == 1 ? UNFILTERED : 0.0;
#if SEAM_TRIALS
    int beyond_lit = queue_trial(r, e.own, OFFSET, 1.0), beyond_dark = queue_trial(r, e.own, OFFSET, 0.0);
#endif
#if BIAS_NORMAL_OFFSET
    int least_bare = queue_trial(r, e.least, bare_map, as_drawn);
#endif
#if FOR_FALSE_LIGHT
    int least_kept = queue_trial(r, max(e.least - e.offset, 0.0), OFFSET + bare_map, as_drawn);
#if BIAS_NORMAL_OFFSET
    int own_bare = queue_trial(r, max(e.own, e.least), 0.0, as_drawn), far_bare = queue_trial(r, e.far, 0.0, as_drawn);
#endif
#endif
#if FOR_FALSE_SHADOW
    int raised = queue_trial(r, e.own + max(e.least - e.equivalent_bias, 0.0), OFFSET, as_drawn);
    int bent_raised = queue_trial(r, e.own + max(e.bent - e.equivalent_bias, 0.0), OFFSET, as_drawn);
    int most_raised = queue_trial(r, e.own + max(e.most - e.equivalent_bias, 0.0), OFFSET, as_drawn);
#endif
#if UNFILTERED_DIFFERS
    int unfiltered = queue_trial(r, e.own, OFFSET + UNFILTERED, as_drawn);
#endif
    run_queued_trials(r);

    e.beyond_lit = e.beyond_dark = v;
    e.least_kept = e.least_bare = e.own_bare = e.far_bare = e.nearest_bare = e.nearest_own_bare = e.unfiltered = v;
    e.raised = e.bent_raised = e.most_raised = v;
    e.nearest_kept = nearest_trial_visibility(r, true, max(e.least_nearest - e.offset, 0.0));
#if SEAM_TRIALS
    e.beyond_lit = trial_results[beyond_lit], e.beyond_dark = trial_results[beyond_dark];
#endif
#if BIAS_NORMAL_OFFSET
    e.least_bare = trial_results[least_bare];
    e.nearest_bare = nearest_trial_visibility(r, false, e.least_nearest);
#endif
#if FOR_FALSE_LIGHT
    e.least_kept = trial_results[least_kept];
#if BIAS_NORMAL_OFFSET
    e.own_bare = trial_results[own_bare], e.far_bare = trial_results[far_bare];
    e.nearest_own_bare = nearest_trial_visibility(r, false, max(e.own, e.least_nearest));
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
