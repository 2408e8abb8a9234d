// Centre of each pixel's kernel in the shown light's map, and whether the kernel reads a texel.
#include "lib/surface.glsl"
layout(location = 0) out vec4 coordinates_out;  // u, v, layer among the light's views, 1: reads

/// Returns true when the kernel reads any texel of the map.
bool reads_map(Receiver r) {
    if (!r.surface.receives || !faces_light(r) || r.where >= BEHIND) return false;
#if map_far_guard
    if (r.where == OUTSIDE_FAR) return false;
#endif
    vec2 at = r.uvd_offset.xy;
#if map_wrap == map_wrap_range
    return !any(lessThan(at, vec2(0.0))) && !any(greaterThan(at, vec2(1.0)));
#elif map_wrap == map_wrap_border
    // A kernel centred outside the map still reads texels in its reach.
    vec2 reach = light_of(r.light).kernel.w / MAP_SIZE;
    return all(greaterThan(at, -reach)) && all(lessThan(at, 1.0 + reach));
#else
    return true;
#endif
}

void main() {
    discard_masked();
    Receiver r = make_receiver(make_surface(), LIGHT_INDEX);
    bool reads = reads_map(r);
    coordinates_out = reads ? vec4(r.uvd_offset.xy, float(r.layer - LIGHT_FIRST_VIEW[LIGHT_INDEX]), 1.0) : vec4(0.0);
}
