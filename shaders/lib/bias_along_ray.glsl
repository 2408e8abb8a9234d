// Shift of a receiver towards the light by the bias, along the light ray.

/// Returns the cosine between light ray and view axis, at least 1e-6: metres along the axis per metre along the ray.
float axis_per_ray(Receiver r) {
    if (LIGHT_WARPED[r.light] != 0) return 1.0;  // parallel rays
    // Axis towards the light: under perspective w is the distance along it, otherwise depth grows against it.
    mat4 m = view_of(r.layer).uvd_from_relative;
    vec3 axis = LIGHT_PERSPECTIVE[r.light] != 0 ? -vec3(m[0][3], m[1][3], m[2][3])
                                               : -away_from_light(1.0) * vec3(m[0][2], m[1][2], m[2][2]);
    return max(dot(r.to_light, axis) * inversesqrt(max(dot(axis, axis), 1e-37)), 1e-6);
}

/// Returns the normal offset along the geometric normal, metres.
vec3 geometric_offset(Receiver r) { return normal_offset(r.surface.geometric, r.to_light, r.texel_m); }

/// Returns the shift along the light ray in metres: depth bias for the geometric normal, plus the normal offset's part.
float bias_along_ray_m(Receiver r) {
    float along_axis_m = metres_towards_light(r, depth_bias(bias_input(r, r.geometric_n_dot_l, r.z)));
    return along_axis_m / axis_per_ray(r) + dot(geometric_offset(r), r.to_light);
}
