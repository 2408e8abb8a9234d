// Depth comparison and depth units by the map's conventions (map.compare, map.reversed_z).

/// Returns the shadow test per component: 1 lit, 0 in shadow. NaN is in shadow.
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

/// Converts depth-buffer value d in [0,1] to metres along the axis. Reversed: near at depth 1. It avoids 1 - d, which would
/// lose the fine steps of a reversed float.
float metres_from_depth(float d, float near, float far, bool perspective, bool reversed) {
    float range = far - near;
    if (!perspective) return reversed ? far - d * range : near + d * range;
    return near * far / (reversed ? near + d * range : far - d * range);
}

/// Converts depth-buffer value d of a warped map, at map coordinate v, to metres along the axis.
/// @param warp DepthWarp
float metres_in_row(float d, vec4 warp, float v, bool reversed) {
    float scale = 1.0 / (1.0 + warp.w * clamp(v, 0.0, 1.0));
    return warp.x + metres_from_depth(d, warp.y, warp.z, false, reversed) * scale;
}

/// Converts a shadow map's depth to metres along the axis, by map.reversed_z.
float metres_from_depth(float d, float near, float far, bool perspective) {
    return metres_from_depth(d, near, far, perspective, map_reversed_z != 0);
}
