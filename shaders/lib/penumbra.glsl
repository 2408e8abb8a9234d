// How wide the penumbra of a light of size is, for kernels that find what stands before the receiver.
#include "lib/disk.glsl"

/// Radius in texels (where they are warped: shortest ones) of the part of the map through which a receiver sees the light, past what stands `gap_m` nearer.
float penumbra_texels(Receiver r, float own_m, float gap_m) {
    float size = light_of(r.light).kernel.x;  // tangent of its angular radius, or its radius in metres
    bool perspective = LIGHT_PERSPECTIVE[r.light] != 0;
    float width_m = LIGHT_TYPE[r.light] == LIGHT_DIRECTIONAL ? size * gap_m
                    : perspective                            ? size * gap_m / max(own_m - gap_m, 1e-6 * own_m)
                                                             : size * gap_m / max(r.distance_m, 1e-6);
    return width_m / r.texel_short_m;
}

/// Metres along the axis at which a map holds a surface, or nothing.
float held_metres(Receiver r, vec2 at, float depth) { return metres_at(r, at, clamp(depth, 0.0, 1.0)); }

/// Metres along the axis at which the receiver is compared.
float compared_metres(Receiver r) { return held_metres(r, r.uvd_offset.xy, r.reference); }

/// The widest that any penumbra gets there, of an occluder at the near plane, before filter.max_radius.
float max_penumbra_radius_texels(Receiver r, float own_m) {
    return penumbra_texels(r, own_m, own_m - begins_m(r, r.uvd_offset.xy));
}
