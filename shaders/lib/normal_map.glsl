// Tangent-space normal maps of glTF 2.0: x along growing u, y along falling v (up in the image).
#include "shared/units.h"
layout(binding = UNIT_NORMAL_MAP) uniform sampler2D normal_map;
in vec3 uv_scale;  // texture coordinates of the normal map; z: scale of its x and y
#ifdef TANGENTS
in vec3 tangent_ws;
in vec3 bitangent_ws;
#endif

vec3 unit_or_zero(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

/// Returns the mapped normal.
/// @param n unit normal, towards the camera
/// @param back the camera sees the triangle's back, where bumps are dents
vec3 mapped_normal(vec3 n, bool back) {
    vec3 front = back ? -n : n;
#ifdef TANGENTS
    vec3 t = unit_or_zero(tangent_ws), b = unit_or_zero(bitangent_ws);
#else
    // Without tangents: along dP/du in the triangle, as Mikkelsen's tangent space (Simulation of Wrinkled Surfaces
    // Revisited, 2008) before smoothing; from screen derivatives as in Schueler, Followup: Normal Mapping
    // Without Precomputed Tangents, 2013.
    vec3 dx = dFdx(position_rel), dy = dFdy(position_rel);
    vec2 du = dFdx(uv_scale.xy), dv = dFdy(uv_scale.xy);
    float turn = du.x * dv.y - dv.x * du.y < 0.0 ? -1.0 : 1.0;
    float metres = max(max(max(abs(dx.x), abs(dx.y)), abs(dx.z)), max(max(abs(dy.x), abs(dy.y)), abs(dy.z)));
    vec2 span = max(abs(du), abs(dv));
    float uvs = max(span.x, span.y);
    if (!(metres > 0.0) || !(uvs > 0.0)) return n;
    dx /= metres, dy /= metres, du /= uvs, dv /= uvs;
    vec3 along_u = (dx * dv.y - dy * du.y) * turn, along_v = (dy * du.x - dx * dv.x) * turn;
    vec3 t = unit_or_zero(along_u - front * dot(front, along_u));
    vec3 b = cross(front, t);
    if (dot(b, along_v) > 0.0) b = -b;
#endif
    vec3 m = texture(normal_map, uv_scale.xy).xyz * 2.0 - 1.0;
    vec3 mapped = unit_or_zero(t * (m.x * uv_scale.z) + b * (m.y * uv_scale.z) + front * m.z);
    if (mapped == vec3(0.0)) return n;
    return back ? -mapped : mapped;
}
