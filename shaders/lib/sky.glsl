// The sky: colours at the zenith, the horizon and below, and a glow about the sun.

/// @param way unit, from the eye @param sun xyz unit, to the sun; w: brightness of the glow
vec3 sky_colour(vec3 way, vec3 zenith, vec3 horizon, vec3 below, vec4 sun) {
    float level = 1.0 - abs(way.y), level2 = level * level, level6 = level2 * level2 * level2;
    bool above = way.y > 0.0;
    vec3 colour = mix(above ? zenith : below, horizon, above ? level6 : level6 * level6);
    float near = max(dot(way, sun.xyz), 0.0);
    near *= near, near *= near, near *= near;
    return colour * (1.0 + sun.w * near);
}
