// Pixel of the static picture that shows the surface of a fragment, which a camera shifted by part of a pixel sees.
// Smoothing averages edges and colour of shifted pictures, but takes visibility from the static one.
layout(binding = UNIT_SEEN_SURFACES) uniform sampler2D seen_position_map;  // relative to the frame's origin, metres
layout(binding = UNIT_SEEN_SURFACES + 1) uniform sampler2D seen_geometric_map;  // 0 where nothing is seen

const float SAME_PLANE_SINE = 0.05;

/// Returns the own pixel where it shows the fragment's plane, else the one of nine whose surface is nearest.
ivec2 unshifted_pixel(Surface s) {
    ivec2 own = ivec2(gl_FragCoord.xy), best = own, last = textureSize(seen_position_map, 0) - 1;
    float nearest = 3e38;
    for (int i = 0; i < 9; ++i) {
        // The own pixel comes first.
        ivec2 at = clamp(own + ivec2((i + 4) % 9 % 3 - 1, (i + 4) % 9 / 3 - 1), ivec2(0), last);
        vec3 normal = texelFetch(seen_geometric_map, at, 0).xyz;
        if (dot(normal, normal) < 0.5) continue;
        vec3 away = texelFetch(seen_position_map, at, 0).xyz - s.position;
        float distance_m = length(away);
        if (i == 0 && max(abs(dot(away, normal)), abs(dot(away, s.geometric))) <= SAME_PLANE_SINE * distance_m) return own;
        if (distance_m < nearest) {
            nearest = distance_m;
            best = at;
        }
    }
    return best;
}
