// Sky over the whole picture: constant colours, and view directions that vary linearly.
#include "lib/frame.glsl"
out vec3 way;  // of any length
flat out vec3 zenith;
flat out vec3 horizon;
flat out vec3 below;
flat out vec4 sun;

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 2, gl_VertexID & 2);
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
    // Parallel rays would all hit one point of the sky, so an orthographic camera shows the sky of a 45 degree lens.
    vec2 half_size = frame.eye.w > 0.5 ? frame.lens.xy * (0.41 / frame.lens.y) : frame.lens.xy;
    way = mat3(frame.relative_from_eye) * vec3((2.0 * corner - 1.0) * half_size, -1.0);
    zenith = frame.sky_zenith.rgb, horizon = frame.sky_horizon.rgb, below = frame.sky_below.rgb;
    sun = frame.sky_sun;
}
