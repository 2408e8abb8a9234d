// Visible surface at a pixel. Passes that need its triangle's corners draw the scene instead of one large triangle.
#include "lib/seen_surface.glsl"

#ifdef TRIANGLE_CORNERS
#include "lib/surface.glsl"

const float SAME_PLACE = 1e-5;  // share of the distance from the origin
#endif

/// Returns the visible surface. Under TRIANGLE_CORNERS it discards fragments of hidden surfaces.
Surface seen_triangle() {
#ifdef TRIANGLE_CORNERS
    discard_masked();
    Surface s = make_surface();
    vec3 seen = texelFetch(seen_position_map, ivec2(gl_FragCoord.xy), 0).xyz;
    if (!(distance(s.position, seen) <= SAME_PLACE * length(seen))) discard;
    return s;
#else
    return seen_surface();
#endif
}
