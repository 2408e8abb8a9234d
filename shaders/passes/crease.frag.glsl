// Share of the picture that contact darkening leaves (look "studio"): creases and places near contacts, from the
// camera's depth. It is no shadow of a light. crease_blur.frag.glsl averages the shares of 4x4 neighbours.
// McGuire, Osman, Bukowski, Hennessy, The Alchemy Screen-Space Ambient Obscurance Algorithm, HPG 2011.
#include "lib/camera_depth.glsl"
layout(location = 0) out float share_out;

const int SAMPLES = 20;
const float TURNS = 7.0;           // of the spiral of samples
const float RADIUS = 0.045;        // of the spiral, by the picture's height
const float STRENGTH = 2.4;
const float DARKEST = 0.55;        // least share of the picture that is left
const float TILT = 0.004;          // height that counts as flat, by the distance from the camera

/// Returns the place of a pixel's surface from the eye, metres along right, up and forwards.
vec3 place_at(ivec2 pixel) {
    vec2 size = vec2(textureSize(camera_depth_map, 0));
    float z = camera_z(depth_at(pixel));
    vec2 ndc = (vec2(pixel) + 0.5) / size * 2.0 - 1.0;
    return vec3(ndc * half_picture_m(z), z);
}

/// Returns the shorter of the steps to both neighbours, so that no step crosses an edge.
vec3 step_along(ivec2 pixel, ivec2 way, vec3 here) {
    vec3 before = here - place_at(pixel - way), after = place_at(pixel + way) - here;
    return abs(before.z) < abs(after.z) ? before : after;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    share_out = 1.0;
    if (depth_at(pixel) == 0.0) return;  // sky
    vec3 here = place_at(pixel);
    vec3 normal = cross(step_along(pixel, ivec2(1, 0), here), step_along(pixel, ivec2(0, 1), here));
    if (dot(normal, normal) == 0.0) return;
    normal = normalize(normal);
    if (dot(normal, here) > 0.0) normal = -normal;
    int height = textureSize(camera_depth_map, 0).y;
    // Length of the spiral's radius at this surface, metres.
    float radius_m = RADIUS * 2.0 * half_picture_m(here.z).y;
    // Each of 4x4 neighbours turns the spiral by another sixteenth, so that their mean has 16 times the samples.
    float turn = 6.28318531 * float((pixel.x & 3) * 4 + (pixel.y & 3)) / 16.0;
    float sum = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        float t = (float(i) + 0.5) / float(SAMPLES), angle = turn + 6.28318531 * TURNS * t;
        ivec2 other = pixel + ivec2(round(t * RADIUS * float(height) * vec2(cos(angle), sin(angle))));
        if (other == pixel || depth_at(other) == 0.0) continue;
        vec3 way = place_at(other) - here;
        float far2 = dot(way, way);
        float fades = max(1.0 - far2 / (4.0 * radius_m * radius_m), 0.0);
        sum += fades * max(dot(way, normal) - TILT * here.z, 0.0) * radius_m / (far2 + 0.01 * radius_m * radius_m);
    }
    float dark = min(STRENGTH * sum / float(SAMPLES), 1.0);
    share_out = mix(1.0, DARKEST, dark);
}
