// The sky where nothing was drawn.
#include "lib/sky.glsl"
#include "lib/tone.glsl"
in vec2 picture_uv;
layout(location = 0) out vec4 colour_out;

void main() {
    // Rays that are parallel would all see one point of it: they see as much as a lens of 45 degrees.
    vec2 half_size = frame.eye.w > 0.5 ? frame.lens.xy * (0.41 / frame.lens.y) : frame.lens.xy;
    vec3 way = mat3(frame.relative_from_eye) * vec3((2.0 * picture_uv - 1.0) * half_size, -1.0);
    vec3 colour = toned(sky_colour(normalize(way)));
    // Half a step of noise hides the steps of a gradient: Jimenez, Next Generation Post Processing in Call of Duty, 2014.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    colour_out = vec4(colour + (noise - 0.5) / 255.0, 1.0);
}
