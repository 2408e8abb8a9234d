// Fragments where any value that the shadow test uses is NaN or infinite (magenta).
bool broken(float v) { return isnan(v) || isinf(v); }

vec4 overlay(Receiver r) {
    bool bad = broken(r.reference) || broken(r.uvd_offset.x) || broken(r.uvd_offset.y) || broken(r.bias_depth) ||
               broken(r.texel_m) || broken(r.n_dot_l) || broken(dot(r.surface.shading, vec3(1.0))) ||
               broken(light_visibility(r.surface, r.light));
    // Behind the light, or without a map, the division by w has no meaning and nothing reads it.
    if (r.where >= BEHIND) bad = broken(r.n_dot_l);
    return bad ? vec4(1.0, 0.0, 1.0, 1.0) : vec4(0.0);
}
