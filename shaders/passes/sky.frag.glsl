// Sky at pixels without geometry.
#include "lib/sky.glsl"
#include "lib/tone.glsl"
#if STUDIO_FLOOR
#include "lib/frame.glsl"
#include "lib/studio_floor.glsl"
#endif
in vec3 way;
flat in vec3 zenith;
flat in vec3 horizon;
flat in vec3 below;
flat in vec4 sun;
layout(location = 0) out vec4 colour_out;

void main() {
    vec3 colour = toned(sky_colour(normalize(way), zenith, horizon, below, sun));
#if STUDIO_FLOOR
    vec3 ray = normalize(way), from_ground = frame_eye().xyz - frame_ground().xyz;
    float metres = -from_ground.y / (abs(ray.y) > 1e-6 ? ray.y : 1e-6);
    vec2 at = from_ground.xz + metres * ray.xz, wide_m = fwidth(at);
    if (metres > 0.0) {
        float radii = length(at) * frame_ground().w;
        colour = toned(floor_colour(ray, radii, zenith, horizon, below, sun)) * grid_share(at, wide_m, radii);
    }
#endif
    // Half a step of noise hides the steps of a gradient: Jimenez, Next Generation Post Processing in Call of Duty, 2014.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    colour_out = vec4(colour + (noise - 0.5) / 255.0, 1.0);
}
