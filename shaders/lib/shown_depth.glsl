// Depth image of the map viewer: a layer of the shadow maps, one of its moments, or the camera's own depth.
#include "shared/units.h"
#ifdef FROM_CAMERA
layout(binding = UNIT_CAMERA_DEPTH) uniform sampler2D shown_map;
float shown_depth(ivec2 texel) { return texelFetch(shown_map, texel, 0).r; }
ivec2 shown_size() { return textureSize(shown_map, 0); }
#elif defined(FROM_CHANNEL)
layout(binding = UNIT_MAP_CHANNEL) uniform sampler2D shown_map;  // one of the kernel's moments
float shown_depth(ivec2 texel) { return texelFetch(shown_map, texel, 0).r; }
ivec2 shown_size() { return textureSize(shown_map, 0); }
#else
#include "lib/shadow_map.glsl"
uniform int layer;
float shown_depth(ivec2 texel) { return stored_texel(texel, layer); }
#if MAP_PAGED
ivec2 shown_size() { return ivec2(map_resolution); }
#else
ivec2 shown_size() { return textureSize(shadow_map, 0).xy; }
#endif
#endif
uniform vec4 curve;  // near, far, 1 perspective, 1 reversed: near at depth 1
uniform vec4 warp;   // DepthWarp; all 0 if the map is not warped

/// Converts a stored depth in row v to metres along the axis.
float shown_metres(float stored, float v) {
    return any(notEqual(warp, vec4(0.0))) ? metres_in_row(stored, warp, v, curve.w > 0.5)
                                          : metres_from_depth(stored, curve.x, curve.y, curve.z > 0.5, curve.w > 0.5);
}
