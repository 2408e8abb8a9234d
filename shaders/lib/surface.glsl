// The surface under the fragment, from the scene vertex shader's outputs.
#include "lib/receiver.glsl"
#include "lib/alpha.glsl"

in vec3 position_rel;
in vec3 normal_ws;

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
    vec3 dx = dFdx(position_rel), dy = dFdy(position_rel);
    float scale = max(max(max(abs(dx.x), abs(dx.y)), abs(dx.z)), max(max(abs(dy.x), abs(dy.y)), abs(dy.z)));
    vec3 n = scale > 0.0 ? cross(dx / scale, dy / scale) : vec3(0.0);
    float n2 = dot(n, n);
    s.geometric = n2 > 0.0 ? n * inversesqrt(n2) : s.to_eye;
    if (dot(s.geometric, s.to_eye) < 0.0) s.geometric = -s.geometric;
    float largest = max(max(abs(normal_ws.x), abs(normal_ws.y)), abs(normal_ws.z));
    s.shading = largest > 0.0 ? normalize(normal_ws / largest) : s.geometric;
    if (dot(s.shading, s.geometric) < 0.0) s.shading = -s.shading;
    return s;
}
