// Sky at pixels without geometry.
#include "lib/sky.glsl"
#include "lib/tone.glsl"
in vec3 way;
flat in vec3 zenith;
flat in vec3 horizon;
flat in vec3 below;
flat in vec4 sun;
layout(location = 0) out vec4 colour_out;

void main() {
    vec3 colour = toned(sky_colour(normalize(way), zenith, horizon, below, sun));
    // Half a step of noise hides the steps of a gradient: Jimenez, Next Generation Post Processing in Call of Duty, 2014.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    colour_out = vec4(colour + (noise - 0.5) / 255.0, 1.0);
}
