// The surface under the fragment, from the scene vertex shader's outputs.
#include "lib/receiver.glsl"
#include "lib/alpha.glsl"

in vec3 position_rel;
in vec3 normal_ws;
#ifdef NORMAL_MAPPED
#include "lib/normal_map.glsl"
#endif

Surface make_surface() {
    Surface s;
    s.position = position_rel;
#ifdef SURFACE_FLAGS
    s.receives = surface.x > 0.5;
#else
    s.receives = true;
#endif
    s.to_eye = frame.eye.w > 0.5 ? -frame.forward.xyz : normalize(frame.eye.xyz - position_rel);
    // Derivatives within a triangle give its plane exactly; the side seen is the one towards the camera.
    // Scaled to the picture, so that their product neither under- nor overflows at any size of scene.
    vec3 n = cross(dFdx(position_rel) * frame.forward.w, dFdy(position_rel) * frame.forward.w);
    float n2 = dot(n, n);
    s.geometric = n2 > 0.0 ? n * inversesqrt(n2) : s.to_eye;
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
