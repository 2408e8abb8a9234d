// The surface under the fragment, from the scene vertex shader's outputs.
#include "shared/units.h"
#include "lib/receiver.glsl"
#include "lib/alpha.glsl"

in vec3 position_rel;
in vec3 normal_ws;
flat in vec3 face_normal;
#ifdef NORMAL_MAPPED
#include "lib/normal_map.glsl"
#endif

Surface make_surface() {
    Surface s;
    s.position = position_rel;
    s.pixel = gl_FragCoord.xy + frame.pixel.xy;
#ifdef SURFACE_FLAGS
    s.receives = surface.x > 0.5;
#else
    s.receives = true;
#endif
#if BIAS_BY_DERIVATIVES
    s.step_x = dFdx(position_rel), s.step_y = dFdy(position_rel);
#endif
    s.to_eye = frame.eye.w > 0.5 ? -frame.forward.xyz : normalize(frame.eye.xyz - position_rel);
    // The triangle's own normal, not that of screen derivatives: of those, single precision leaves a tenth of a degree.
    float n2 = dot(face_normal, face_normal);
    s.geometric = n2 > 0.0 ? face_normal * inversesqrt(n2) : s.to_eye;  // the side seen is the one towards the camera
    if (dot(s.geometric, s.to_eye) < 0.0) s.geometric = -s.geometric;
    float length2 = dot(normal_ws, normal_ws);
    s.vertex = length2 > 0.0 ? normal_ws * inversesqrt(length2) : s.geometric;
    if (dot(s.vertex, s.geometric) < 0.0) s.vertex = -s.vertex;
    s.shading = s.vertex;
#ifdef NORMAL_MAPPED
    s.shading = mapped_normal(s.vertex, dot(normal_ws, s.geometric) < 0.0);
#endif
    return s;
}
