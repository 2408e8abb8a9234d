// Equivalent depth bias of the settings, and least bias of the chosen kernel: renderer/bias/account.h in single precision.
// Depths are in depth-buffer units; texels_nearer() converts them to texels.
#include "biases/raster.glsl"

/// Returns the least bias without acne on the plane, for the chosen kernel and bias.
float least_bias(Receiver r, vec2 gradient) {
#if BIAS_PER_TEXEL
    if (!is_in_map(r)) return 0.0;
    float kernel = rise_per_texel(gradient, light_of(r.light).kernel.y);
    return max(kernel - max_texel_shift(r), 0.0) + least_bias_per_texel(r, gradient);
#else
    return least_bias(r, gradient, light_of(r.light).kernel.y);
#endif
}

/// Returns the format's step of which polygon offset counts units: in float formats that at the greatest depth of the
/// triangle, if its corners are known.
float offset_quantum(Receiver r) {
#ifdef TRIANGLE_CORNERS
    ViewBlock view = view_of(r.layer);
    float greatest = 0.0;
    for (int k = 0; k < 3; ++k) {
        vec4 h = view.uvd_from_relative * vec4(r.surface.corners[k], 1.0);
        bool is_cut = LIGHT_PERSPECTIVE[r.light] != 0 && h.w <= view.curve.x;
        greatest = max(greatest, is_cut ? float(map_reversed_z) : clamp(h.z / h.w, 0.0, 1.0));
    }
    return float_step(greatest);
#else
    return depth_quantum(r);
#endif
}

/// CasterShift by layer: an engine has moved its casters away from the light by w - |dot(normal, xyz)| metres.
uniform vec4 caster_shift[SI_MAX_VIEWS];

/// Returns the depth by which an engine's shader has moved the receiver's plane away from the light in the map.
float caster_shift_depth(Receiver r) {
    vec4 shift = caster_shift[r.layer];
    float metres = shift.w - abs(dot(r.surface.geometric, shift.xyz));
    if (metres == 0.0) return 0.0;
    return -depth_change_towards_light(LIGHT_PERSPECTIVE[r.light] != 0, nearest_z(r), r.z, r.depth_per_m, r.z, -metres);
}

/// Returns the equivalent depth bias: distance from the receiver's plane to the compared depth, towards the light.
float equivalent_depth_bias(Receiver r, vec2 gradient) {
    float plane = r.uvd.z + dot(gradient, r.uvd_offset.xy - r.uvd.xy);
    return away_from_light(plane - r.reference) + raster_offset(abs(gradient) / MAP_SIZE, offset_quantum(r)) +
           caster_shift_depth(r);
}
