// Volume that a caster's disc sweeps away from a light.
#include "lib/frame.glsl"

/// Light ray through the middle of a disc, and the spread of the disc along it.
struct Sweep {
    vec3 axis;         // unit, away from the light
    float distance_m;  // distance of the middle from the light; 0: parallel rays
};

/// Returns the sweep of a disc with this middle.
Sweep sweep_of(vec3 middle) {
    LightBlock light = light_of(LIGHT_INDEX);
    if (LIGHT_TYPE[LIGHT_INDEX] == LIGHT_DIRECTIONAL) return Sweep(-light.to_light.xyz, 0.0);
    vec3 from_light = middle - light.position.xyz;
    return Sweep(normalize(from_light), max(length(from_light), 1e-6));
}

/// Returns the disc's radius `along` metres past its middle, relative to the radius at the middle.
float spread_at(Sweep s, float along) { return s.distance_m > 0.0 ? 1.0 + along / s.distance_m : 1.0; }
