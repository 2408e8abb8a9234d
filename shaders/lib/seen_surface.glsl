// Visible surface at a pixel, as stored by passes/seen_surfaces.frag.glsl, equal in every bit to the drawn one.
#include "shared/units.h"
#include "lib/receiver.glsl"
layout(binding = UNIT_SEEN_SURFACES) uniform sampler2D seen_position_map;   // relative to the frame's origin, metres; A: receives
layout(binding = UNIT_SEEN_SURFACES + 1) uniform sampler2D seen_geometric_map;  // A: in the map
#if bias_normal_source != bias_normal_source_geometric
layout(binding = UNIT_SEEN_SURFACES + 2) uniform sampler2D seen_bias_normal_map;
#endif
#if BIAS_BY_DERIVATIVES
layout(binding = UNIT_SEEN_SURFACES + 3) uniform sampler2D seen_step_x_map;
layout(binding = UNIT_SEEN_SURFACES + 4) uniform sampler2D seen_step_y_map;
#endif

/// Returns the visible surface at a pixel. Among interpolated normals only the one of bias.normal_source is known. The
/// direction to the eye is not known.
Surface seen_surface(ivec2 at) {
    vec4 position = texelFetch(seen_position_map, at, 0);
    Surface s;
    s.position = position.xyz;
    s.pixel = vec2(at) + 0.5 + frame_pixel().xy;
    s.receives = position.w > 0.5;
    vec4 geometric = texelFetch(seen_geometric_map, at, 0);
    s.geometric = geometric.xyz;
    s.in_map = geometric.w > 0.5;
#if bias_normal_source != bias_normal_source_geometric
    s.vertex = s.shading = texelFetch(seen_bias_normal_map, at, 0).xyz;
#else
    s.vertex = s.shading = s.geometric;
#endif
    s.to_eye = vec3(0.0);
#if BIAS_BY_DERIVATIVES
    s.step_x = texelFetch(seen_step_x_map, at, 0).xyz, s.step_y = texelFetch(seen_step_y_map, at, 0).xyz;
#endif
    return s;
}

Surface seen_surface() { return seen_surface(ivec2(gl_FragCoord.xy)); }
