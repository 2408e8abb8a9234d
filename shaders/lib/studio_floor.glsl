// Endless ground of the look "studio": it continues the ground disc under a model up to the horizon, with a 1 m grid.

const float GRID_DARKENS = 0.22;
const float FOG_RADII = 2.5;  // distance at which the horizon's colour has 63 %, in radii of the ground disc

/// Returns the share of a grid's lines at a place; lines finer than a pixel fade.
/// @param spacing_m distance of the lines @param wide_m change of `at` over a pixel
float grid_lines(vec2 at, vec2 wide_m, float spacing_m) {
    vec2 place = at / spacing_m, wide = max(wide_m / spacing_m, vec2(1e-6));
    vec2 off = abs(fract(place + 0.5) - 0.5) / wide;  // pixels to the nearest line
    vec2 line = clamp(1.25 - off, 0.0, 1.0) * clamp(1.0 - 5.0 * wide, 0.0, 1.0);
    return max(line.x, line.y);
}

/// Returns the share of the ground's colour that the grid leaves: lines each metre, and stronger ones each 10 m.
/// @param at place on the ground from its centre, metres @param wide_m change of `at` over a pixel
/// @param radii distance from the centre in radii of the ground disc
float grid_share(vec2 at, vec2 wide_m, float radii) {
    float lines = max(grid_lines(at, wide_m, 1.0), grid_lines(at, 0.7 * wide_m, 10.0));
    return 1.0 - GRID_DARKENS * lines * exp(-0.6 * radii);
}

/// Returns the ground's colour away from the model, before the tone curve: the colour below the horizon, with the
/// horizon's haze in the distance.
/// @param way unit vector from the eye @param radii distance from the centre in radii of the ground disc
vec3 floor_colour(vec3 way, float radii, vec3 zenith, vec3 horizon, vec3 below, vec4 sun) {
    vec2 level = way.xz / max(length(way.xz), 1e-6);
    return mix(sky_colour(vec3(level.x, 0.0, level.y), zenith, horizon, below, sun), below, exp(-radii / FOG_RADII));
}
