// Sky: colours at the zenith, the horizon and below, and a glow around the sun.

/// Returns the colour of the sky in a direction.
/// @param way unit vector from the eye
/// @param sun xyz: unit vector to the sun; w: brightness of the glow
vec3 sky_colour(vec3 way, vec3 zenith, vec3 horizon, vec3 below, vec4 sun) {
    float level = 1.0 - abs(way.y), level2 = level * level, level6 = level2 * level2 * level2;
    bool above = way.y > 0.0;
    vec3 colour = mix(above ? zenith : below, horizon, above ? level6 : level6 * level6);
    float near = max(dot(way, sun.xyz), 0.0);
    near *= near, near *= near, near *= near;
    return colour * (1.0 + sun.w * near);
}
