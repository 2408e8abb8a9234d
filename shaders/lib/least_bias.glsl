// How much bias a triangle's plane needs, and how much it gets: renderer/bias/theory.h and bias_account.h in single
// precision. Depths are in depth-buffer units; texels_nearer() makes texels of them.

/// The plane's depth gradient over the map, per map width. From two directions within the plane and their steps in the
/// map by the quotient rule; that of depth is known in closed form, where a quotient would cancel.
vec2 plane_gradient(Receiver r) {
    vec3 n = r.surface.geometric;
    vec3 along = normalize(abs(n.x) > abs(n.z) ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y));
    mat4 m = frame.views[r.layer].uvd_from_relative;
    vec4 p = m * vec4(along, 0.0), q = m * vec4(cross(n, along), 0.0);
    vec2 depth = vec2(p.z, q.z);
    vec2 a = p.xy, b = q.xy;
    if (LIGHT_PERSPECTIVE[r.light] != 0) {
        depth = vec2(away(r.depth_per_m * p.w), away(r.depth_per_m * q.w));
        a = (p.xy - r.uvd.xy * p.w) / r.w;
        b = (q.xy - r.uvd.xy * q.w) / r.w;
    }
    return vec2(depth.x * b.y - depth.y * a.y, depth.y * a.x - depth.x * b.x) / (a.x * b.y - a.y * b.x);
}

/// One step of the stored depth at r.
float depth_quantum(Receiver r) {
#if map_format == map_format_d16
    return 1.0 / 65535.0;
#elif map_format == map_format_d24
    return 1.0 / 16777215.0;
#else
    return exp2(floor(log2(clamp(r.uvd.z, 1.17549435e-38, 1.0))) - 23.0);
#endif
}

/// @param reach_texels how far the centre of a texel that is compared may lie, per axis
float least_bias(Receiver r, vec2 gradient, float reach_texels) {
    float per_texel = (abs(gradient.x) + abs(gradient.y)) / float(map_resolution);
    vec3 farthest = max(abs(r.surface.position), abs(r.surface.position - frame.map_origin.xyz));
    float extent = max(max(0.5 * r.texel_m * float(map_resolution), farthest.x), max(farthest.y, farthest.z));
    float snapping = SUBPIXEL_BITS > 0 ? exp2(-float(SUBPIXEL_BITS + 1)) : 0.0;
    return (reach_texels + snapping) * per_texel + depth_quantum(r) +
           exp2(-21.0) * max(extent * r.depth_per_m, r.uvd.z);
}

/// Of the chosen kernel.
float least_bias(Receiver r, vec2 gradient) { return least_bias(r, gradient, frame.lights[r.light].kernel.y); }

/// How far all bias brings the compared depth before the receiver's own plane.
float bias_worth(Receiver r, vec2 gradient) {
    float plane = r.uvd.z + dot(gradient, r.uvd_offset.xy - r.uvd.xy);
    vec2 per_texel = abs(gradient) / float(map_resolution);
    float slope = frame.offset.z * (frame.offset.w != 0.0 ? length(per_texel) : max(per_texel.x, per_texel.y));
    float raster = bias_raster_slope * slope + bias_raster_units * (frame.offset.x + frame.offset.y * depth_quantum(r));
    if (bias_raster_clamp > 0.0) raster = min(raster, bias_raster_clamp);
    return away(plane - r.reference) + raster;
}
