// Light that reaches a point without regard to shadows.
#include "lib/receiver.glsl"

/// Returns a light's colour times intensity. If all lights are grey, one channel is enough; a directional light stores it
/// next to its direction.
vec3 radiance_of(LightBlock light, int type) {
#if LIGHTS_GREY
    if (type == LIGHT_DIRECTIONAL) return light.to_light.www;
    return light.radiance.rrr;
#else
    return light.radiance.rgb;
#endif
}

/// Returns the radiance that arrives without shadows: inverse square falloff, smooth edge of the spot's cone, and the range
/// window of KHR_lights_punctual.
vec3 unshadowed_radiance(int index, vec3 to_light, float distance_m) {
    LightBlock light = light_of(index);
    if (LIGHT_TYPE[index] == LIGHT_DIRECTIONAL) return radiance_of(light, LIGHT_DIRECTIONAL);
    float cone = LIGHT_TYPE[index] == LIGHT_SPOT
        ? smoothstep(light.to_light.w, max(light.radiance.w, light.to_light.w + 1e-6), dot(to_light, light.to_light.xyz))
        : 1.0;
    float window = 1.0;
    if (LIGHT_RANGED[index] != 0) {
        float share = distance_m / light.position.w, squared = share * share;
        window = clamp(1.0 - squared * squared, 0.0, 1.0);
    }
    return radiance_of(light, LIGHT_TYPE[index]) * (cone * window) / max(distance_m * distance_m, 1e-12);
}

/// Returns true when the light's visibility can change the picture at a surface. Otherwise the light contributes nothing,
/// lit or not.
bool needs_visibility(int index, Surface s, vec3 to_light, float distance_m) {
#if SKIPS_UNLIT && shading_composition != shading_composition_dim_lit
    return dot(s.shading, to_light) > 0.0 && any(greaterThan(unshadowed_radiance(index, to_light, distance_m), vec3(0.0)));
#else
    return true;
#endif
}
