// Camera depth of a pixel, and its distance from the camera.
#include "lib/frame.glsl"
layout(binding = UNIT_CAMERA_DEPTH) uniform sampler2D camera_depth_map;  // reversed: 0 is far

/// Converts camera depth to metres along the camera's axis.
float camera_z(float depth) {
    return frame_eye().w > 0.5 ? frame.lens.w - depth * frame.lens.z : 1.0 / (depth * frame.lens.z + frame.lens.w);
}

/// Returns half the picture's width and height at a distance along the camera's axis, metres.
vec2 half_picture_m(float z) { return frame.lens.xy * (frame_eye().w > 0.5 ? 1.0 : z); }

/// Returns the camera depth of a pixel, or of the nearest pixel of the picture.
float depth_at(ivec2 pixel) {
    return texelFetch(camera_depth_map, clamp(pixel, ivec2(0), textureSize(camera_depth_map, 0) - 1), 0).r;
}
