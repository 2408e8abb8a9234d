// The sky: colours at the zenith, the horizon and below, and a glow about the sun.
#include "lib/frame.glsl"

/// @param way unit, from the eye
vec3 sky_colour(vec3 way) {
    float level = 1.0 - abs(way.y), sunk = level * level;
    vec3 beyond = way.y > 0.0 ? frame.sky_zenith.rgb : frame.sky_below.rgb;
    vec3 colour = mix(beyond, frame.sky_horizon.rgb, way.y > 0.0 ? sunk * sunk * sunk : pow(level, 12.0));
    float near = max(dot(way, frame.sky_sun.xyz), 0.0);
    near *= near, near *= near, near *= near;
    return colour * (1.0 + frame.sky_sun.w * near);
}
