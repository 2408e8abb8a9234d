// Surface of the fragment, from the outputs of passes/scene.vert.glsl.
#include "shared/units.h"
#include "lib/receiver.glsl"
#include "lib/alpha.glsl"

in vec3 position_rel;
in vec3 normal_ws;
flat in vec3 face_normal;
uniform int faces_left_out;  // faces that are not drawn into maps: 1 fronts, 2 backs
#ifdef NORMAL_MAPPED
#include "lib/normal_map.glsl"
#endif
#ifdef TRIANGLE_CORNERS
#include "lib/triangle_corners.glsl"
#endif

Surface make_surface() {
    Surface s;
    // A triangle edge-on to the camera covers a pixel by rounding alone, and its interpolated position may be invalid. Any
    // position will then do that gives finite numbers, equal in every pass.
    s.position = abs(position_rel.x) < 1e30 ? position_rel : face_normal;
    s.pixel = gl_FragCoord.xy + frame_pixel().xy;
#ifdef SURFACE_FLAGS
    s.receives = surface.x > 0.5;
#else
    s.receives = true;
#endif
#ifdef TRIANGLE_CORNERS
    for (int k = 0; k < 3; ++k) s.corners[k] = triangle_corner(k);
#endif
    s.in_map = (faces_left_out & (gl_FrontFacing ? 1 : 2)) == 0;
#if BIAS_BY_DERIVATIVES
    s.step_x = dFdx(s.position), s.step_y = dFdy(s.position);
#endif
#if CAMERA_PARALLEL
    s.to_eye = -frame.forward.xyz;
#else
    s.to_eye = normalize(frame_eye().xyz - s.position);
#endif
    s.geometric = face_normal;
    bool turned_away = dot(normal_ws, face_normal) < 0.0;
    float length2 = dot(normal_ws, normal_ws), per_length = inversesqrt(length2);
    s.vertex = length2 > 0.0 ? normal_ws * (turned_away ? -per_length : per_length) : s.geometric;
    s.shading = s.vertex;
#ifdef NORMAL_MAPPED
    s.shading = mapped_normal(s.vertex, turned_away);
#endif
    return s;
}
