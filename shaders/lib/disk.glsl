// A disk of places about a receiver, for kernels that sample a circle.

/// An angle for each pixel, in radians: any 3x3 pixels' angles are spread over the turn.
/// Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare, SIGGRAPH 2014 (interleaved gradient noise).
float pixel_angle(vec2 pixel) {
    return 6.28318531 * fract(52.9829189 * fract(dot(floor(pixel), vec2(0.06711056, 0.00583715))));
}

/// The turn of the disk at a receiver, of which turned() makes use.
vec2 disk_turn(Receiver r) {
#if filter_rotate
    float angle = pixel_angle(r.surface.pixel);
    return vec2(cos(angle), sin(angle));
#else
    return vec2(1.0, 0.0);
#endif
}

vec2 turned(vec2 v, vec2 turn) { return vec2(v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x); }

/// A place of a disk across the light's rays as one in the map, whose texels are warped: in its shortest ones.
vec2 on_map(Receiver r, vec2 place) { return LIGHT_WARPED[r.light] != 0 ? r.disk * place : place; }

/// A place of the disk of filter.radius: in metres it lies across the light's rays, in texels in the map.
vec2 of_radius(Receiver r, vec2 place) {
#if filter_radius_unit == filter_radius_unit_metres
    return on_map(r, place);
#else
    return place;
#endif
}

/// filter.radius in texels of the receiver's map.
float disk_radius_texels(Receiver r) {
#if filter_radius_unit == filter_radius_unit_metres
    return min(filter_radius / r.texel_short_m, filter_max_radius);
#else
    return filter_radius;
#endif
}
