// Fragments outside the light's map: beyond its sides (orange), beyond its far plane (blue), behind the
// light (magenta).
vec4 overlay(Receiver r) {
    if (r.where == OUTSIDE_SIDES) return vec4(0.90, 0.55, 0.10, 1.0);
    if (r.where == OUTSIDE_FAR) return vec4(0.15, 0.45, 0.85, 1.0);
    if (r.where == BEHIND) return vec4(0.80, 0.25, 0.70, 1.0);
    return vec4(0.0);
}
