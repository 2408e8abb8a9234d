// Moments: functions of depths, averaged around each texel by the moments pass. moments_of() in the kernel's file gives
// the functions. Depths are shares of the map's range along its axis, 0 near to 1 far, for any format and direction.
#include "shared/units.h"
#include "shared/moments.h"
#include "lib/shadow_map.glsl"
#include "lib/footprint.glsl"

/// Returns the moments of a single depth; the kernel's row stores as many of the four as it has channels.
vec4 moments_of(float share);

/// Converts a stored or compared depth to its share of the range.
float share_of_range(float depth, float near, float far, bool perspective) {
    if (!perspective) return map_reversed_z != 0 ? 1.0 - depth : depth;
    return (metres_from_depth(depth, near, far, true) - near) / (far - near);
}

float share_of_range(float depth, Receiver r) {
    vec4 curve = view_of(r.layer).curve;
    return share_of_range(depth, curve.x, curve.y, LIGHT_PERSPECTIVE[r.light] != 0);
}

/// Converts a stored depth to its share, clamped to the range. Rounding beyond the range would overflow exponentials.
float stored_share(float depth, float near, float far, bool perspective) {
    return clamp(share_of_range(depth, near, far, perspective), 0.0, 1.0);
}

float own_share(Receiver r) { return share_of_range(r.reference, r); }

/// Returns true when the border answers outside the map. Faces of a point light have no outside.
bool has_border(Receiver r) {
#if map_wrap == map_wrap_border
    return LIGHT_TYPE[r.light] != LIGHT_POINT;
#else
    return false;
#endif
}

vec4 border_moments() {
#if map_outside == map_outside_lit
    return moments_of(1.0);
#else
    return moments_of(0.0);
#endif
}

/// Returns true when a trial (MAP_TRIALS) replaces the moments, by `answer`.
bool trial_moments(Receiver r, vec2 at, out vec4 answer) {
    answer = vec4(0.0);
#ifdef MAP_TRIALS
    if (beyond_answer >= 0.0 && (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0))))) {
        answer = moments_of(beyond_answer > 0.5 ? 1.0 : 0.0);
        return true;
    }
    if (map_is_unfiltered) {
        answer = moments_of(clamp(share_of_range(map_depth(at, r.layer), r), 0.0, 1.0));
        return true;
    }
#endif
    return false;
}

#if !MOMENTS_SUMMED
layout(binding = UNIT_MOMENTS) uniform MAPS moments_map;

#if MOMENTS_QUANTISED
// Peters, Klein, Moment Shadow Mapping, I3D 2015, on optimised quantisation: an affine transform that spreads the four
// moments of depths over the range of 16 bits per channel.
vec4 quantised(vec4 moments) {
    return mat4(MOMENTS_QUANTISE) * moments + vec4(MOMENTS_QUANTISE_OFFSET, 0.0, 0.0, 0.0);
}
vec4 restored(vec4 stored) {
    return mat4(MOMENTS_RESTORE) * (stored - vec4(MOMENTS_QUANTISE_OFFSET, 0.0, 0.0, 0.0));
}
#else
vec4 quantised(vec4 moments) { return moments; }
vec4 restored(vec4 stored) { return stored; }
#endif

/// Returns the moments at a place of the map, blended from 2x2 texels; with filter.mips over the pixel's footprint.
vec4 map_moments(Receiver r, vec2 at) {
    vec4 moments;
    if (trial_moments(r, at, moments)) return moments;
#ifdef MARK_TEXELS
    map_gather(round(at * MAP_SIZE) / MAP_SIZE, r.layer);  // marks the blended 2x2 texels
#endif
#if filter_mips
    mat2 print = pixel_footprint(r);
    moments = restored(textureGrad(moments_map, IN_LAYER(at, r.layer), print[0], print[1]));
#else
    moments = restored(textureLod(moments_map, IN_LAYER(at, r.layer), 0.0));
#endif
    if (has_border(r)) {
        // Blend with the border as in a sampler, at the finest level.
        vec2 held = clamp(at * MAP_SIZE + 0.5, 0.0, 1.0) *
                    clamp((1.0 - at) * MAP_SIZE + 0.5, 0.0, 1.0);
        // mix() would lose all digits of the smaller number.
        float share = held.x * held.y;
        moments = share * moments + (1.0 - share) * border_moments();
    }
    return moments;
}
#endif

/// Returns the upper bound of the share at `own` or behind, from mean and mean square: Chebyshev's inequality, one-sided
/// (Cantelli's).
float chebyshev(vec2 moments, float own, float least_variance) {
    if (own <= moments.x) return 1.0;
    float variance = max(moments.y - moments.x * moments.x, least_variance), behind = own - moments.x;
    return variance / (variance + behind * behind);
}

/// Light-bleed reduction (Lauritzen, GPU Gems 3, chapter 8, 2007): values below filter.bleed become shadow.
float without_bleeding(float bound) { return clamp((bound - filter_bleed) / (1.0 - filter_bleed), 0.0, 1.0); }

/// Records the moments of a look-up in `found`; see Filtered.
void record_moments(vec4 moments, float mean, float variance, float margin, float own, float bound, float texels) {
    found.moments = moments;
    found.mean = mean;
    found.variance = variance;
    found.margin = margin;
    found.own = own;
    found.bound = bound;
    found.taps = texels;
}
