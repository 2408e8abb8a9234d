// Visibility from the baked light map (renderer/reference/light_map.h), found by the pixel's triangle. Arvo,
// Backward Ray Tracing, SIGGRAPH 1986 course notes; Abrash, Quake's Lighting Model, 1997.
#include "shared/units.h"
layout(binding = UNIT_LIGHT_MAP) uniform sampler2DArray light_map;  // the light uses layer LIGHT_MAP_LAYER

struct LightMapChart {
    vec4 u, v;   // texels per metre across and up the atlas; w: place of the scene's centre in the atlas, texels
    vec4 reach;  // range of texel coordinates of look-ups
};
layout(std430, binding = STORAGE_LIGHT_MAP_OBJECTS) readonly buffer LightMapObjects {
    vec4 light_map_origin;      // xyz: the frame's origin relative to the scene's centre, metres
    uvec2 light_map_objects[];  // of each object: index of the first triangle, number of triangles
};
layout(std430, binding = STORAGE_LIGHT_MAP_TRIANGLES) readonly buffer LightMapTriangles { uint light_map_charts_of[]; };
layout(std430, binding = STORAGE_LIGHT_MAP_CHARTS) readonly buffer LightMapCharts { LightMapChart light_map_charts[]; };

float source_visibility(Surface s, int light) {
    if (!s.receives) return 1.0;
    // Texels store visibility for the side towards the light.
    if (!faces_light(s, light)) return 0.0;
    uvec2 part = light_map_objects[uint(surface.w)];
    // Drivers may continue gl_PrimitiveID through the instances of a draw.
    uint chart_of = light_map_charts_of[part.x + uint(gl_PrimitiveID) % max(part.y, 1u)];
    if (chart_of == 0xffffffffu) return 1.0;  // a triangle without area
    LightMapChart chart = light_map_charts[chart_of];
    vec3 p = s.position + light_map_origin.xyz;
    vec2 at = vec2(dot(chart.u.xyz, p) + chart.u.w, dot(chart.v.xyz, p) + chart.v.w);
    at = clamp(at, chart.reach.xy, chart.reach.zw);
    return textureLod(light_map, vec3(at / vec2(textureSize(light_map, 0).xy), LIGHT_MAP_LAYER), 0.0).r;
}
