// Mean of the contact darkening of 4x4 neighbours on the same surface (crease.frag.glsl). It multiplies the picture.
#include "lib/camera_depth.glsl"
layout(binding = UNIT_SHADED) uniform sampler2D shares;
layout(location = 0) out vec4 share_out;

const float SAME_SURFACE = 0.01;  // distance from the plane of a pixel, by the distance from the camera

/// Returns the smaller of the changes of depth to both neighbours, so that none crosses an edge. Depths are linear
/// across the picture on a plane, as metres are not.
float change_along(ivec2 pixel, ivec2 way, float here) {
    float before = here - depth_at(pixel - way), after = depth_at(pixel + way) - here;
    return abs(before) < abs(after) ? before : after;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(shares, 0) - 1;
    float here = depth_at(pixel), z = camera_z(here);
    share_out = vec4(1.0);
    if (here == 0.0) return;  // sky
    vec2 slope = vec2(change_along(pixel, ivec2(1, 0), here), change_along(pixel, ivec2(0, 1), here));
    float sum = 0.0, weight = 0.0;  // the pixel itself always counts
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            ivec2 other = clamp(pixel + ivec2(x, y), ivec2(0), last);
            float depth = depth_at(other), plane = here + dot(slope, vec2(other - pixel));
            if (depth == 0.0 || abs(camera_z(depth) - camera_z(max(plane, 1e-30))) > SAME_SURFACE * z) continue;
            sum += texelFetch(shares, other, 0).r;
            weight += 1.0;
        }
    share_out = vec4(vec3(sum / weight), 1.0);
}
