// Penumbra width of a light with size, for kernels that find casters before the receiver.
#include "lib/disk.glsl"

/// Returns the penumbra radius in texels (in a warped map: shortest texels) for a caster `gap_m` nearer to the light.
float penumbra_texels(Receiver r, float own_m, float gap_m) {
    float size = light_of(r.light).kernel.x;  // tangent of the angular radius, or radius in metres
    bool perspective = LIGHT_PERSPECTIVE[r.light] != 0;
    float width_m = LIGHT_TYPE[r.light] == LIGHT_DIRECTIONAL ? size * gap_m
                    : perspective                            ? size * gap_m / max(own_m - gap_m, 1e-6 * own_m)
                                                             : size * gap_m / max(r.distance_m, 1e-6);
    return width_m / r.texel_short_m;
}

/// Converts a stored depth, clamped to the range, to metres along the axis.
float clamped_metres(Receiver r, vec2 at, float depth) { return metres_at(r, at, clamp(depth, 0.0, 1.0)); }

/// Returns the compared distance along the axis, metres: the receiver's, less its bias.
float compared_metres(Receiver r) { return clamped_metres(r, r.uvd_offset.xy, r.reference); }

/// Returns the receiver's own distance along the axis, metres. Distances of casters are measured from there.
float surface_metres(Receiver r) { return clamped_metres(r, r.uvd.xy, r.uvd.z); }

/// Returns the largest possible penumbra radius in texels, of a caster at the near plane, before filter.max_radius.
float max_penumbra_radius_texels(Receiver r, float own_m) {
    return penumbra_texels(r, own_m, own_m - near_plane_m(r, r.uvd_offset.xy));
}
