// Corners of shadow volumes: the scene's triangles, bit for bit at the positions of the camera's passes, and their copies
// away from the light. Copies are infinitely far (w = 0), or at a distance with VOLUME_FINITE.
#include "lib/frame.glsl"

layout(location = 0) in vec4 corner_os;  // w: 1 infinitely far away
layout(location = 4) in vec4 row0;
layout(location = 5) in vec4 row1;
layout(location = 6) in vec4 row2;

#if VOLUME_FINITE
uniform float reach;  // metres, or distances of the corner from the light
#endif

invariant gl_Position;

void main() {
    vec4 p = vec4(corner_os.xyz, 1.0);
    vec3 position_rel = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
    gl_Position = frame.clip_from_relative * vec4(position_rel, 1.0);
#if VOLUME_SIDES
    if (corner_os.w > 0.5) {
        LightBlock light = frame.lights[LIGHT_INDEX];
        bool parallel = LIGHT_TYPE[LIGHT_INDEX] == LIGHT_DIRECTIONAL;
        vec3 away = parallel ? -light.to_light.xyz : position_rel - light.position.xyz;
#if VOLUME_FINITE
        gl_Position = frame.clip_from_relative * vec4(position_rel + away * reach, 1.0);
#else
        gl_Position = frame.clip_from_relative * vec4(away, 0.0);
#endif
    }
#endif
#if VOLUME_BEYOND_FAR
    gl_ClipDistance[0] = -gl_Position.z;  // depth is reversed: 0 at the far plane
#endif
}
