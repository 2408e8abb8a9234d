// Fragments with a NaN or infinite value in the shadow test (magenta).
bool is_non_finite(float v) { return isnan(v) || isinf(v); }

vec4 overlay(Receiver r) {
    bool bad = is_non_finite(r.reference) || is_non_finite(r.uvd_offset.x) || is_non_finite(r.uvd_offset.y) || is_non_finite(r.bias_depth) ||
               is_non_finite(r.texel_m) || is_non_finite(r.n_dot_l) || is_non_finite(dot(r.surface.shading, vec3(1.0))) ||
               is_non_finite(light_visibility(r.surface, r.light));
    // Behind the light, or without a map, the division by w has no meaning and nothing reads it.
    if (r.where >= BEHIND) bad = is_non_finite(r.n_dot_l);
    return bad ? vec4(1.0, 0.0, 1.0, 1.0) : vec4(0.0);
}
