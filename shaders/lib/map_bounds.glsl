// Look-ups that the nearest and the farthest depth within the kernel's reach answer, so that taps cannot differ.
#if MAP_BOUNDS && !defined(MAP_TRIALS) && !defined(RECORD_TAPS) && !defined(MARK_TEXELS)
#define ASKS_BOUNDS 1
layout(binding = UNIT_MAP_BOUNDS) uniform MAPS map_bounds;

/// 1 or 0 where every tap of the kernel would say so; below 0 where taps have to tell.
float bounded_visibility(Receiver r) {
    vec2 at = r.uvd_offset.xy;
    ivec2 last = textureSize(map_bounds, 0).xy - 1;
    ivec2 block = clamp(ivec2(at * float(map_resolution)) / BOUNDS_BLOCK, ivec2(0), last);
#if MAP_LAYERS > 1
    vec2 stored = texelFetch(map_bounds, ivec3(block, r.layer), 0).rg;
#else
    vec2 stored = texelFetch(map_bounds, block, 0).rg;
#endif
    stored = depth_of_stored(stored.rgrg, r.layer).rg;
    vec2 own = compared_bounds(r, frame.lights[r.light].kernel.w + 1.0) + vec2(-BOUNDS_MARGIN, BOUNDS_MARGIN);
#if map_reversed_z
    stored = stored.yx, own = own.yx;
#endif
    bool inside = all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(1.0)));
    if (inside && depth_test(own.y, stored.x) > 0.5) return 1.0;
#if BOUNDS_TELL_DARK
    if (inside && depth_test(own.x, stored.y) < 0.5) return 0.0;
#endif
    return -1.0;
}
#endif

/// A number of a kernel's taps, told so that a CPU's compiler keeps their loop, which look-ups without taps then leave.
#if KEEPS_LOOPS
int looped(int taps) { return taps + int(frame.pixel.w); }
#else
#define looped(taps) (taps)
#endif
