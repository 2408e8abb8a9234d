// How much bias a receiver's plane needs, and what the chosen row of the bias table gives it: renderer/bias/theory.h and
// renderer/settings/biases.h in single precision. Depths are in depth-buffer units. Needs Receiver and its functions of
// lib/receiver.glsl, which includes this.
#include "lib/across.glsl"

/// The plane's depth gradient over the map, per map width. From two directions within the plane and their steps in the
/// map by the quotient rule; that of depth is known in closed form, where a quotient would cancel.
/// @param u, v two directions within the plane, of any length
vec2 gradient_along(Receiver r, vec3 u, vec3 v) {
    mat4 m = view_of(r.layer).uvd_from_relative;
    vec4 p = m * vec4(u, 0.0), q = m * vec4(v, 0.0);
    vec2 depth = vec2(p.z, q.z);
    vec2 a = p.xy, b = q.xy;
    if (LIGHT_WARPED[r.light] != 0) {
        depth = (depth - r.uvd.z * vec2(p.w, q.w)) / r.w;
        a = (p.xy - r.uvd.xy * p.w) / r.w;
        b = (q.xy - r.uvd.xy * q.w) / r.w;
    }
    if (LIGHT_PERSPECTIVE[r.light] != 0) {
        depth = vec2(away(r.depth_per_m * p.w), away(r.depth_per_m * q.w));
        a = (p.xy - r.uvd.xy * p.w) / r.w;
        b = (q.xy - r.uvd.xy * q.w) / r.w;
    }
    return vec2(depth.x * b.y - depth.y * a.y, depth.y * a.x - depth.x * b.x) / (a.x * b.y - a.y * b.x);
}

vec2 plane_gradient(Receiver r) {
    vec3 n = r.surface.geometric;
    vec3 along = across(n);
    return gradient_along(r, along, cross(n, along));
}

/// One step of a 32-bit float between 0 and 1.
float float_step(float v) { return exp2(floor(log2(clamp(v, 1.17549435e-38, 1.0))) - 23.0); }

/// One step of the stored depth at r; as renderer/bias/theory.h has it.
float depth_quantum(Receiver r) {
#if map_format == map_format_d16
    return 1.0 / 65535.0;
#elif map_format == map_format_d24
    return 1.0 / 16777215.0;
#elif MAP_HOLDS_DISTANCES
    vec4 curve = view_of(r.layer).curve;
    bool perspective = LIGHT_PERSPECTIVE[r.light] != 0;
    float share = perspective ? (map_reversed_z != 0 ? curve.y - r.z : r.z - curve.x) / (curve.y - curve.x) : r.uvd.z;
#if map_format == map_format_linear
    float steps = float_step(share);
#else
    float steps = 1.0 / 65535.0;
#endif
    return perspective ? (steps * (curve.y - curve.x) + exp2(-21.0) * r.z) * r.depth_per_m + 4.0 * float_step(r.uvd.z)
                       : steps;
#else
    return float_step(r.uvd.z);
#endif
}

/// The largest coordinate that shaders compute with here, in metres.
float extent_m(Receiver r) {
    vec3 farthest = max(abs(r.surface.position), abs(r.surface.position - frame.map_origin.xyz));
    return max(max(0.5 * r.texel_m * float(map_resolution), farthest.x), max(farthest.y, farthest.z));
}

/// Where one depth is compared with all texels.
/// @param reach_texels how far the centre of a texel that is compared may lie, per axis
float least_bias(Receiver r, vec2 gradient, float reach_texels) {
    float per_texel = (abs(gradient.x) + abs(gradient.y)) / float(map_resolution);
    float snapping = SUBPIXEL_BITS > 0 ? exp2(-float(SUBPIXEL_BITS + 1)) : 0.0;
    return (reach_texels + snapping) * per_texel + depth_quantum(r) +
           exp2(-21.0) * max(extent_m(r) * (r.depth_per_m + r.warp_per_m * r.uvd.z), r.uvd.z);
}

/// Where every texel is compared with the plane at its centre: besides, what roundings of map coordinates are worth.
float least_bias_per_texel(Receiver r, vec2 gradient) {
    float per_m = 1.0 / (r.texel_short_m * float(map_resolution)) + r.warp_per_m;
    return least_bias(r, gradient, 0.0) + exp2(-21.0) * extent_m(r) * per_m * (abs(gradient.x) + abs(gradient.y));
}

struct BiasInput {
    bool perspective;   // the view of the light
    float nearest;      // metres along its axis: nothing comes nearer
    float n_dot_l;      // of the normal that bias.normal_source chooses
    float texel_m;      // world size of a texel at the receiver
    float z;            // metres along the axis of the point that is looked up
    float own_z;        // of the receiver
    float depth_per_m;  // at own_z
    vec2 gradient;      // of the plane's depth over the map; 0 where rows of the table do not read it (BIAS_READS_PLANE)
    float least_per_texel;         // least_bias_per_texel(); likewise
    float least_common;        // least_bias() of the chosen kernel; likewise
};

/// An amount in bias.unit as depth.
float unit_depth(BiasInput b, float amount) {
#if bias_unit == bias_unit_texels
    return depth_nearer(b.perspective, b.nearest, b.own_z, b.depth_per_m, b.z, amount * b.texel_m);
#elif bias_unit == bias_unit_metres
    return depth_nearer(b.perspective, b.nearest, b.own_z, b.depth_per_m, b.z, amount);
#else
    return amount;
#endif
}

#include BIAS_FILE

/// @param n_dot_l of the normal that counts
/// @param z metres along the axis of the point that is looked up
BiasInput bias_input(Receiver r, float n_dot_l, float z) {
    BiasInput b = BiasInput(LIGHT_PERSPECTIVE[r.light] != 0, nearest_z(r), n_dot_l, r.texel_m, z, r.z, r.depth_per_m,
                            vec2(0.0), 0.0, 0.0);
#if BIAS_READS_PLANE
    // Edge-on there is no gradient, and no look-up.
    if (faces_light(r)) {
#if BIAS_BY_DERIVATIVES
        b.gradient = gradient_along(r, r.surface.step_x, r.surface.step_y);
#else
        b.gradient = plane_gradient(r);
#endif
#if BIAS_PER_TEXEL
        b.least_per_texel = least_bias_per_texel(r, b.gradient);
#else
        b.least_common = least_bias(r, b.gradient, light_of(r.light).kernel.y);
#endif
    }
#endif
    return b;
}

#if BIAS_PER_TEXEL
/// By how much the compared depth may differ from the receiver's own, whatever its plane.
float max_texel_shift(Receiver r) {
    return bias_plane_clamp > 0.0 ? bias_plane_clamp * r.texel_m * r.depth_per_m : 3e38;
}
#endif
