// Look-ups answered by bounds of the map's depths (two planes), without taps.
#if MAP_BOUNDS && !defined(MAP_TRIALS) && !defined(RECORD_TAPS) && !defined(MARK_TEXELS)
#define USES_BOUNDS 1
layout(binding = UNIT_MAP_BOUNDS) uniform MAPS map_bounds;  // passes/map_bounds.frag.glsl

/// Returns the smallest and largest stored depth within `texels` of a place, per axis, by the bounds of its block. The
/// receiver's own depth rises by `slope` per texel and is subtracted.
vec2 stored_bounds(vec4 bounds, vec2 from_middle, float texels, vec2 slope) {
    vec2 steeper = abs(bounds.xy - slope), size = abs(bounds.xy);
    float spread = (steeper.x + steeper.y) * texels + BOUNDS_MARGIN * (1.0 + 64.0 * (size.x + size.y));
    return bounds.zw + dot(bounds.xy, from_middle) + vec2(-spread, spread);
}

/// Returns 1 or 0 if every tap of the kernel would give it; below 0 if taps are needed.
float bounded_visibility(Receiver r) {
    vec2 at = r.uvd_offset.xy * MAP_SIZE;
    ivec2 block = clamp(ivec2(at) / BOUNDS_BLOCK, ivec2(0), textureSize(map_bounds, 0).xy - 1);
    vec4 bounds = texelFetch(map_bounds, TEXEL_IN_LAYER(block, r.layer), 0);
    float texels = light_of(r.light).kernel.w + 1e-3;  // 1e-3: rounding of map coordinates
    vec2 from_middle = at - (vec2(block) + 0.5) * float(BOUNDS_BLOCK);
    bool known = all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, MAP_SIZE));
    vec2 slope = vec2(0.0);
#if BIAS_PER_TEXEL
    slope = r.reference_slope / MAP_SIZE;
    // Clamped texel depths (max_texel_shift()) do not follow the slope.
    known = known && (abs(slope.x) + abs(slope.y)) * (texels + 1.0) <= max_texel_shift(r) &&
            abs(r.reference - 0.5) + (abs(slope.x) + abs(slope.y)) * (texels + 1.0) <= 0.5;
#endif
    vec2 stored = stored_bounds(bounds, from_middle, texels, slope);
    stored = depth_of_stored(stored.xyxy, r.layer).xy + vec2(-DEPTHS_MARGIN, DEPTHS_MARGIN);
#if map_reversed_z
    stored = stored.yx;
#endif
    if (known && depth_test(r.reference, stored.x) > 0.5) return 1.0;
#if BOUNDS_TELL_DARK
    float least = r.reference;
#if BIAS_HAS_REMAINDER
    // The farthest tap may be this much nearer to the light than the plane.
    least -= away_from_light((abs(slope.x) + abs(slope.y) + 1.5 * r.remainder) * (texels + 1.0));
#endif
    if (known && depth_test(least, stored.y) < 0.5) return 0.0;
#endif
    return -1.0;
}
#endif

/// Returns a number of taps such that compilers for CPUs keep the loop, which look-ups without taps then skip.
#if KEEPS_LOOPS
int loop_bound(int taps) { return taps + int(frame_pixel().w); }
#else
#define loop_bound(taps) (taps)
#endif
