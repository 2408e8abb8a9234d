// Shading by Blinn-Phong: (ambient + visibility * (diffuse + specular)) * colour; the ambient part is never shadowed.
// Blinn, Models of Light Reflection for Computer Synthesized Pictures, SIGGRAPH 1977.
#include "shared/units.h"
#include "lib/surface.glsl"
#include "lib/visibility.glsl"
#include "lib/arriving.glsl"
#include "lib/tone.glsl"
#ifdef GROUND
#include "lib/sky.glsl"
#if STUDIO_FLOOR
#include "lib/studio_floor.glsl"
#endif
#endif

#ifdef SEPARATE_VISIBILITY
layout(binding = UNIT_VISIBILITY) uniform sampler2DArray visibility_map;
#ifdef SMOOTHED
#include "lib/unshifted_pixel.glsl"
#endif
#elif defined(SMOOTHED)
#include "lib/unshifted_surface.glsl"
#endif
layout(location = 0) out vec4 colour_out;

/// Returns the highlight: the cosine to the half vector, to the power of the shininess. A power of two is computed by
/// squarings, which also avoids the root, since the half vector's squared length is 2 + 2 l.v.
float highlight(Surface s, vec3 l, float n_dot_l) {
#if !SHADES_HIGHLIGHT
    return 0.0;
#elif SHININESS_SQUARINGS > 0
    float across = max(n_dot_l + dot(s.shading, s.to_eye), 0.0);
    float power = across * across / max(2.0 + 2.0 * dot(l, s.to_eye), 1e-12);
    for (int i = 1; i < SHININESS_SQUARINGS; ++i) power *= power;
    return power;
#else
    return pow(max(dot(s.shading, normalize(l + s.to_eye)), 0.0), shading_shininess);
#endif
}

#if shading_composition == shading_composition_dim_lit
const float LIT = 0.99;  // threshold of the alpha test
#ifdef LIT_PASS
bool any_lit = false;
#endif
#endif

/// Returns the visibility of a light: 1 lit, 0 in shadow. Lights with an empty map need no look-up.
float visibility_of(int light, Surface s, vec3 to_light) {
    if (LIGHT_EMPTY[light] != 0) return float(!s.receives || faces_light(s, to_light));
    return light_visibility(s, light);
}

#ifdef SEPARATE_VISIBILITY
ivec2 visibility_at = ivec2(0);  // pixel of visibility_map
#endif

/// Returns the reflected light of one light: visibility * (diffuse + specular) * radiance.
vec3 light_share(int i, Surface s) {
    float distance_m;
    vec3 l = direction_to(i, s.position, distance_m);
    float n_dot_l = dot(s.shading, l);
#ifdef DIM_PASS
    float visibility = 0.0;
#elif defined(SEPARATE_VISIBILITY)
    float visibility = texelFetch(visibility_map, ivec3(visibility_at, i), 0).r;
#elif defined(SMOOTHED)
    Surface still = unshifted_surface(s);
    float still_m;
    vec3 still_l = direction_to(i, still.position, still_m);
    float visibility = needs_visibility(i, still, still_l, still_m) ? visibility_of(i, still, still_l) : 1.0;
#else
    float visibility = needs_visibility(i, s, l, distance_m) ? visibility_of(i, s, l) : 1.0;
#endif
#if shading_composition == shading_composition_dim_lit
#ifdef LIT_PASS
    any_lit = any_lit || visibility >= LIT;
#endif
    visibility = visibility >= LIT ? 1.0 : shading_dim;
#endif
    float bright = shading_diffuse * n_dot_l + shading_specular * highlight(s, l, n_dot_l);
    float reflected = n_dot_l > 0.0 ? bright : 0.0;
    return (visibility * reflected) * unshadowed_radiance(i, l, distance_m);
}

void main() {
    vec4 base = base_colour();
#ifdef MASKED
    if (base.a < surface.y) discard;
#endif
    Surface s = make_surface();
#ifdef SEPARATE_VISIBILITY
#ifdef SMOOTHED
    visibility_at = unshifted_pixel(s);
#else
    visibility_at = ivec2(gl_FragCoord.xy);
#endif
#endif
#if SKY_LIGHTS
    vec4 ambient = frame_ambient();
    // The axis points to the brightest part of the sky. Few values are read, since CPU drivers read each one again for
    // every few pixels.
    vec3 sum = ambient.rgb * (1.0 + dot(s.shading, frame_ambient_rise().xyz));
#else
    vec3 sum = vec3(shading_ambient);
#endif
#define ADD_LIGHT(i) sum += light_share(i, s);
    EACH_SHINING_LIGHT(ADD_LIGHT)
#ifdef LIT_PASS
    if (!any_lit) discard;
#endif
#if EXPOSED
#if SKY_LIGHTS
    sum *= ambient.w;
#else
    sum *= frame_ambient().w;
#endif
#endif
    vec3 colour = toned(sum * base.rgb);
#ifdef SURFACE_FLAGS
    if (surface.z > 0.5) colour = srgb(base.rgb);
#endif
#ifdef GROUND
    // The ground disc under a model fades into the background.
    float out_there = smoothstep(0.5, 1.0, distance(s.position.xz, frame_ground().xz) * frame_ground().w);
#if STUDIO_FLOOR
    vec2 at = s.position.xz - frame_ground().xz;
    float radii = length(at) * frame_ground().w;
    vec3 away = toned(floor_colour(-s.to_eye, radii, frame_sky_zenith().rgb, frame_sky_horizon().rgb,
                                   frame_sky_below().rgb, frame_sky_sun()));
    colour = mix(colour, away, out_there) * grid_share(at, fwidth(at), radii);
#elif SKY_LIGHTS
    colour = mix(colour, toned(sky_colour(-s.to_eye, frame_sky_zenith().rgb, frame_sky_horizon().rgb, frame_sky_below().rgb,
                                      frame_sky_sun())), out_there);
#else
    colour = mix(colour, BACKGROUND, out_there);
#endif
#endif
#ifdef BLEND
    colour_out = vec4(colour, base.a);
#else
    colour_out = vec4(colour, 1.0);
#endif
}
