// Depths that let only the surfaces of wrong pixels pass, so that trials are made for those alone: elsewhere the depth
// is the camera's near plane.
#include "lib/truth.glsl"
layout(binding = 4) uniform sampler2D camera_depth_map;
uniform float near_depth;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int bits = int(texelFetch(judged_map, at, 0).z);
    gl_FragDepth = (bits & MARKED_BITS) != 0 ? texelFetch(camera_depth_map, at, 0).r : near_depth;
}
