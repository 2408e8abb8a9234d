// Difference in texels between map coordinates from world space and from eye space, in single precision.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    vec4 world = uvd_from_world(view_of(r.layer), r.surface.position);
    vec4 eye = uvd_from_eye(view_of(r.layer), r.surface.position);
    if (LIGHT_PERSPECTIVE[r.light] == 0 && LIGHT_WARPED[r.light] == 0) world.w = eye.w = 1.0;
    return vec4(length((world.xy / world.w - eye.xy / eye.w) * MAP_SHAPE) * float(map_resolution));
}
