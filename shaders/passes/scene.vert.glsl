// Vertex shader of all passes that draw the scene from the camera. Equal input gives equal positions in each pass.
#include "lib/frame.glsl"
#include "lib/vertex_colour.glsl"

layout(location = 0) in vec3 position_os;
layout(location = 1) in vec3 normal_os;
layout(location = 4) in vec4 row0;
layout(location = 5) in vec4 row1;
layout(location = 6) in vec4 row2;
layout(location = 9) in vec3 normal_row0;
layout(location = 10) in vec3 normal_row1;
layout(location = 11) in vec3 normal_row2;
#ifdef NORMAL_MAPPED
layout(location = 12) in vec3 uv_scale_in;
#ifdef TANGENTS
layout(location = 13) in vec4 tangent_os;
out vec3 tangent_ws;
out vec3 bitangent_ws;
#endif
out vec3 uv_scale;
#endif
layout(location = 14) in vec3 face_os;  // normal of the triangle that has this vertex as its last corner

out vec3 position_rel;
flat out vec3 face_normal;  // unit, on the side that the camera sees
out vec3 normal_ws;
#ifdef TRIANGLE_CORNERS
flat out vec4 world_row0, world_row1, world_row2;
#endif
invariant gl_Position;

/// Returns the triangle's normal, turned to the camera. A normal from screen derivatives would be off by a tenth of a
/// degree in single precision. The value of the last corner applies to all fragments (flat).
vec3 seen_face_normal(vec3 normal, vec3 position) {
#if CAMERA_PARALLEL
    vec3 to_eye = -frame.forward.xyz;
#else
    vec3 to_eye = frame.eye.xyz - position;
#endif
    float length2 = dot(normal, normal);  // 0 of a triangle without area
    vec3 unit = length2 > 0.0 ? normal * inversesqrt(length2) : normalize(to_eye);
    return dot(unit, to_eye) < 0.0 ? -unit : unit;
}

void main() {
    vec4 p = vec4(position_os, 1.0);
    position_rel = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
    normal_ws = vec3(dot(normal_row0, normal_os), dot(normal_row1, normal_os), dot(normal_row2, normal_os));
    face_normal = seen_face_normal(
        vec3(dot(normal_row0, face_os), dot(normal_row1, face_os), dot(normal_row2, face_os)), position_rel);
    pass_base_colour();
#ifdef TRIANGLE_CORNERS
    world_row0 = row0, world_row1 = row1, world_row2 = row2;
#endif
#ifdef NORMAL_MAPPED
    uv_scale = uv_scale_in;
#ifdef TANGENTS
    vec3 t = tangent_os.xyz, b = cross(normal_os, t) * tangent_os.w;
    tangent_ws = vec3(dot(row0.xyz, t), dot(row1.xyz, t), dot(row2.xyz, t));
    bitangent_ws = vec3(dot(row0.xyz, b), dot(row1.xyz, b), dot(row2.xyz, b));
#endif
#endif
    gl_Position = frame.clip_from_relative * vec4(position_rel, 1.0);
}
