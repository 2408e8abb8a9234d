// Disk of places around a receiver, for kernels that sample a circle.

/// Returns an angle for each pixel, in radians. The angles of any 3x3 pixels are spread evenly.
/// Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare, SIGGRAPH 2014 (interleaved gradient noise).
float pixel_angle(vec2 pixel) {
    return 6.28318531 * fract(52.9829189 * fract(dot(floor(pixel), vec2(0.06711056, 0.00583715))));
}

/// Returns the rotation of the disk at a receiver, for rotated(): cosine and sine.
vec2 disk_rotation(Receiver r) {
#if filter_rotate
    float angle = pixel_angle(r.surface.pixel);
    return vec2(cos(angle), sin(angle));
#else
    return vec2(1.0, 0.0);
#endif
}

/// Rotates v.
/// @param turn cosine and sine
vec2 rotated(vec2 v, vec2 turn) { return vec2(v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x); }

/// Converts a place of a disk across the light's rays to the map. In a warped or stretched map the unit is the shortest
/// texel.
vec2 disk_to_map(Receiver r, vec2 place) {
    return LIGHT_WARPED[r.light] != 0 || LIGHT_STRETCHED[r.light] != 0 ? r.disk * place : place;
}

/// Converts a place of the disk of filter.radius to the map. A radius in metres is across the light's rays, one in texels
/// in the map.
vec2 radius_to_map(Receiver r, vec2 place) {
#if filter_radius_unit == filter_radius_unit_metres
    return disk_to_map(r, place);
#else
    return place;
#endif
}

/// Returns filter.radius in texels of the receiver's map.
float disk_radius_texels(Receiver r) {
#if filter_radius_unit == filter_radius_unit_metres
    return min(filter_radius / r.texel_short_m, filter_max_radius);
#else
    return filter_radius;
#endif
}
