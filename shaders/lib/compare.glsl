// Compared depths of a look-up, which differ for each texel with some rows of bias.kind.

/// Clamps a compared depth to 0 to 1 for integer formats, as shadow samplers do.
vec4 reference_of(vec4 depth) {
#if (!FILTER_SAMPLER || COMPARE_BY_HAND) && (map_format == map_format_d16 || map_format == map_format_d24)
    return clamp(depth, 0.0, 1.0);
#else
    return depth;
#endif
}
float reference_of(float depth) { return reference_of(vec4(depth)).x; }

#if BIAS_PER_TEXEL
/// Returns the change of the plane's depth from the look-up to map coordinates.
vec4 plane_shift(Receiver r, vec4 u, vec4 v) {
    float most = max_texel_shift(r);
    vec4 moved = r.reference_slope.x * (u - r.uvd_offset.x) + r.reference_slope.y * (v - r.uvd_offset.y);
    return clamp(moved, -most, most);
}

/// Returns the depths that are compared where they differ from the one at the look-up by `moved`.
vec4 reference_moved(Receiver r, vec4 moved) {
    vec4 depth = r.reference + moved;
    // The plane may continue behind the far plane, where the map is empty.
#if map_reversed_z
    return reference_of(max(depth, min(r.reference, 0.0)));
#else
    return reference_of(min(depth, max(r.reference, 1.0)));
#endif
}

/// Returns the compared depths at map coordinates: the receiver's plane, with bias and remainder.
vec4 reference_at(Receiver r, vec4 u, vec4 v) {
    vec4 moved = plane_shift(r, u, v);
#if BIAS_HAS_REMAINDER
    if (r.remainder > 0.0) {
        vec4 across = (u - r.uvd_offset.x) * MAP_SHAPE.x, up = (v - r.uvd_offset.y) * MAP_SHAPE.y;
        vec4 away_texels = sqrt(across * across + up * up) * float(map_resolution);
        moved = away_from_light(1.0) * (min(away_from_light(1.0) * moved, 0.0) - r.remainder * away_texels);
    }
#endif
    return reference_moved(r, moved);
}

vec2 texel_centre(vec2 at) { return (floor(at * MAP_SIZE) + 0.5) / MAP_SIZE; }
#endif

/// Returns the compared depth for the texel at a place of the map.
float compared_depth(Receiver r, vec2 at) {
#if BIAS_PER_TEXEL
    at = texel_centre(at);
    return reference_at(r, at.xxxx, at.yyyy).x;
#else
    return r.reference;
#endif
}

/// Corrects a weighted mean of comparisons for rounded weights: 1 if all taps are lit.
float normalised_share(float share) { return share > 1.0 - 1e-6 ? 1.0 : share; }

/// Returns the depth of the receiver's plane at a texel's centre minus the one at a place in the texel.
float plane_within_texel(Receiver r, vec2 at) {
#if BIAS_PER_TEXEL
    vec2 centre = texel_centre(at);
    return reference_moved(r, plane_shift(r, centre.xxxx, centre.yyyy)).x -
           reference_moved(r, plane_shift(r, at.xxxx, at.yyyy)).x;
#else
    return 0.0;
#endif
}

/// Returns the comparisons of the four texels around a corner of the receiver's map, in textureGather order.
vec4 gather_lit(Receiver r, vec2 meet) {
#if BIAS_PER_TEXEL
    vec2 half_texel = 0.5 / MAP_SIZE;
    vec4 own = reference_at(r, meet.x + vec4(-half_texel.x, half_texel.x, half_texel.x, -half_texel.x),
                            meet.y + vec4(half_texel.y, half_texel.y, -half_texel.y, -half_texel.y));
    return depth_test(own, map_gather(meet, r.layer));
#else
    return depth_test(r.reference, map_gather(meet, r.layer));
#endif
}

/// Returns one comparison at a place of the receiver's map, by filter.method: 1 lit, 0 in shadow. It takes the nearest
/// texel, or blends 2x2 texels where the kernel is bilinear.
float compares_lit(Receiver r, vec2 at) {
#if SAMPLER_BILINEAR && !FILTER_SAMPLER
    vec2 between = at * MAP_SIZE - 0.5, texel = floor(between), f = between - texel;
    vec4 lit = gather_lit(r, (texel + 1.0) / MAP_SIZE);
    return normalised_share(mix(mix(lit.w, lit.z, f.x), mix(lit.x, lit.y, f.x), f.y));
#else
    float own = compared_depth(r, at);
#if BIAS_PER_TEXEL
    at = texel_centre(at);  // the centre keeps the sampler's rounding from reading a neighbour
#endif
#if FILTER_SAMPLER
    return map_compare_at(at, r.layer, own);
#else
    return depth_test(own, map_depth(at, r.layer));
#endif
#endif
}
