// A disk of places about a receiver, for kernels that sample a circle.

/// In the unit disk, each the farthest from all before it of thousands thrown at random (best candidates), so that the
/// first few of them, too, lie well apart. Mitchell, Spectrally Optimal Sampling for Distribution Ray Tracing, 1991.
const int DISK_TABLE = 64;
const vec2 POISSON_DISK[DISK_TABLE] = vec2[](
    vec2(0.0176, 0.0156), vec2(-0.4099, -0.6259), vec2(-0.7253, 0.1984), vec2(0.3960, -0.6429),
    vec2(-0.1782, 0.7364), vec2(0.7500, 0.1089), vec2(0.4490, 0.6640), vec2(-0.7950, -0.2763),
    vec2(0.7650, -0.3640), vec2(-0.0042, -0.8534), vec2(0.0078, -0.4194), vec2(-0.3095, 0.2997),
    vec2(-0.3811, -0.1485), vec2(-0.5918, 0.6159), vec2(0.4013, -0.1557), vec2(0.3626, 0.2594),
    vec2(0.0389, 0.4386), vec2(0.1510, 0.8523), vec2(0.7455, 0.4642), vec2(-0.7025, -0.5593),
    vec2(-0.2747, -0.8624), vec2(-0.8983, -0.0216), vec2(0.8914, -0.1271), vec2(0.2810, -0.3944),
    vec2(-0.2676, -0.3971), vec2(0.6655, -0.6218), vec2(-0.1480, -0.6311), vec2(0.2590, -0.8711),
    vec2(-0.5397, -0.3538), vec2(-0.4699, 0.0956), vec2(-0.4259, 0.7980), vec2(-0.7698, 0.4414),
    vec2(0.6437, -0.1140), vec2(0.1484, -0.6358), vec2(-0.3473, 0.5547), vec2(-0.2246, 0.0601),
    vec2(-0.1176, -0.1952), vec2(-0.6436, -0.0793), vec2(0.2726, 0.4922), vec2(0.5222, -0.3995),
    vec2(0.1299, -0.1970), vec2(0.2476, 0.0549), vec2(-0.5383, 0.3779), vec2(0.5126, 0.0805),
    vec2(0.5048, 0.4379), vec2(-0.0684, 0.2327), vec2(-0.0592, 0.9204), vec2(0.1221, 0.6418),
    vec2(0.1404, 0.2501), vec2(0.8697, 0.2935), vec2(0.3572, 0.8534), vec2(0.6288, 0.2716),
    vec2(0.6490, 0.6620), vec2(-0.1662, 0.4662), vec2(-0.9157, 0.1838), vec2(-0.5612, -0.7455),
    vec2(0.4435, -0.8260), vec2(0.9330, 0.0573), vec2(-0.2444, 0.9029), vec2(-0.0539, 0.5930),
    vec2(0.2851, 0.6963), vec2(-0.5514, -0.5146), vec2(-0.0038, 0.7579), vec2(-0.8287, -0.4366));

/// Place i of n along a spiral over the unit disk, each a golden angle on: even whatever n is.
/// Vogel, A Better Way to Construct the Sunflower Head, Mathematical Biosciences 44, 1979.
vec2 spiral_place(int i, int n) {
    // The golden angle in whole parts of a turn, of which whole turns fall away without rounding.
    float angle = float(uint(i) * 2654435769u) * (6.28318531 / 4294967296.0);
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}

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
