// Depth comparison as the map's convention has it, never assumed.

/// The shadow test per component: 1 lit, 0 in shadow. NaN is in shadow.
vec4 depth_test(vec4 own, vec4 stored) {
#if map_reversed_z && map_compare == map_compare_lequal
    return vec4(greaterThanEqual(own, stored));
#elif map_reversed_z
    return vec4(greaterThan(own, stored));
#elif map_compare == map_compare_lequal
    return vec4(lessThanEqual(own, stored));
#else
    return vec4(lessThan(own, stored));
#endif
}

vec4 depth_test(float own, vec4 stored) { return depth_test(vec4(own), stored); }

float depth_test(float own, float stored) { return depth_test(own, vec4(stored)).x; }

/// Metres along the axis at depth-buffer value d in [0,1]; reversed: near at depth 1. Without 1 - d, which would lose
/// the fine steps of a reversed float.
float metres_from_depth(float d, float near, float far, bool perspective, bool reversed) {
    float range = far - near;
    if (!perspective) return reversed ? far - d * range : near + d * range;
    return near * far / (reversed ? near + d * range : far - d * range);
}

/// The same in a row of a map that is warped, at map coordinate v.
/// @param warp as in DepthWarp
float metres_in_row(float d, vec4 warp, float v, bool reversed) {
    float scale = 1.0 / (1.0 + warp.w * clamp(v, 0.0, 1.0));
    return warp.x + metres_from_depth(d, warp.y, warp.z, false, reversed) * scale;
}

/// The same under the shadow map's convention.
float metres_from_depth(float d, float near, float far, bool perspective) {
    return metres_from_depth(d, near, far, perspective, map_reversed_z != 0);
}
