// Needed bias of a receiver's plane, and the bias of the chosen row of the bias table: renderer/bias/theory.h and
// renderer/settings/biases.h in single precision. Depths are in depth-buffer units. lib/receiver.glsl includes this file
// after Receiver and its functions.
#include "lib/across.glsl"

/// Returns the plane's depth gradient over the map, per map width, by the quotient rule along two directions in the plane.
/// The change of depth has a closed form, since its quotient would cancel.
/// @param u, v directions in the plane, of any length
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
        depth = vec2(away_from_light(r.depth_per_m * p.w), away_from_light(r.depth_per_m * q.w));
        a = (p.xy - r.uvd.xy * p.w) / r.w;
        b = (q.xy - r.uvd.xy * q.w) / r.w;
    }
    return vec2(depth.x * b.y - depth.y * a.y, depth.y * a.x - depth.x * b.x) / (a.x * b.y - a.y * b.x);
}

/// Returns the depth gradient of the triangle's plane over the map, per map width.
vec2 plane_gradient(Receiver r) {
    vec3 n = r.surface.geometric;
    vec3 along = perpendicular_to(n);
    return gradient_along(r, along, cross(n, along));
}

/// Returns the step of a 32-bit float at v, between 0 and 1.
float float_step(float v) { return exp2(floor(log2(clamp(v, 1.17549435e-38, 1.0))) - 23.0); }

/// Returns the step of the stored depth at r (renderer/bias/theory.h).
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

/// Returns the largest coordinate in the shader's computations at r, metres, for the rounding error.
float extent_m(Receiver r) {
    vec3 farthest = max(abs(r.surface.position), abs(r.surface.position - frame.map_origin.xyz));
    return max(max(0.5 * r.texel_m * float(map_resolution), farthest.x), max(farthest.y, farthest.z));
}

/// Returns true when the map holds the receiver's own face, which can then shadow itself. Culled faces, objects that cast
/// nothing and points before the near plane are not in the map.
bool is_in_map(Receiver r) { return r.surface.in_map && away_from_light(r.uvd.z - float(map_reversed_z)) >= 0.0; }

/// Returns the least bias without acne on the plane if all texels share one compared depth; 0 for a face that is not in the
/// map.
/// @param reach_texels largest distance to the centre of a compared texel, per axis
float least_bias(Receiver r, vec2 gradient, float reach_texels) {
    if (!is_in_map(r)) return 0.0;
    float per_texel = rise_per_texel(gradient, 1.0);
    float snapping = SUBPIXEL_BITS > 0 ? exp2(-float(SUBPIXEL_BITS + 1)) : 0.0;
    return (reach_texels + snapping) * per_texel + depth_quantum(r) +
           exp2(-21.0) * max(extent_m(r) * (r.depth_per_m + r.relative_dw_per_m * r.uvd.z), r.uvd.z);
}

/// Returns the least bias without acne if each texel is compared with the plane at its centre. It includes the rounding of
/// map coordinates.
float least_bias_per_texel(Receiver r, vec2 gradient) {
    if (!is_in_map(r)) return 0.0;
    float per_m = 1.0 / (r.texel_short_m * min(MAP_SIZE.x, MAP_SIZE.y)) + r.relative_dw_per_m;
    return least_bias(r, gradient, 0.0) + exp2(-21.0) * extent_m(r) * per_m * (abs(gradient.x) + abs(gradient.y));
}

/// Inputs of a bias for one receiver; BiasInput of renderer/settings/biases.h.
struct BiasInput {
    bool perspective;   // view of the light is perspective
    float nearest;      // least distance along the light's axis, metres
    float n_dot_l;      // cosine between the light and the normal of bias.normal_source
    float texel_m;      // world size of a texel at the receiver
    float z;            // distance of the looked-up point along the axis, metres
    float own_z;        // distance of the receiver along the axis, metres
    float depth_per_m;  // depth change per metre along the axis, at own_z
    vec2 gradient;      // gradient of the plane's depth over the map; 0 unless BIAS_READS_PLANE
    float least_per_texel;  // least_bias_per_texel(); 0 unless BIAS_READS_PLANE
    float least_common;     // least_bias() of the chosen kernel; 0 unless BIAS_READS_PLANE
    bool in_map;            // is_in_map(); false unless BIAS_READS_PLANE
};

/// Converts an amount in bias.unit to depth-buffer units.
float unit_depth(BiasInput b, float amount) {
#if bias_unit == bias_unit_texels
    return depth_change_towards_light(b.perspective, b.nearest, b.own_z, b.depth_per_m, b.z, amount * b.texel_m);
#elif bias_unit == bias_unit_metres
    return depth_change_towards_light(b.perspective, b.nearest, b.own_z, b.depth_per_m, b.z, amount);
#else
    return amount;
#endif
}

#include BIAS_FILE

/// Returns the inputs of the chosen bias at r.
/// @param n_dot_l cosine between the light and the normal of bias.normal_source
/// @param z distance of the looked-up point along the axis, metres
BiasInput bias_input(Receiver r, float n_dot_l, float z) {
    BiasInput b = BiasInput(LIGHT_PERSPECTIVE[r.light] != 0, nearest_z(r), n_dot_l, r.texel_m, z, r.z, r.depth_per_m,
                            vec2(0.0), 0.0, 0.0, false);
#if BIAS_READS_PLANE
    b.in_map = is_in_map(r);
    // A plane edge-on to the light has no gradient, and no look-up.
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
/// Returns the limit of bias.plane_clamp: the largest difference between a texel's compared depth and the receiver's.
float max_texel_shift(Receiver r) {
    return bias_plane_clamp > 0.0 ? bias_plane_clamp * r.texel_m * r.depth_per_m : 3e38;
}
#endif
