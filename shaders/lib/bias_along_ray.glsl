// How far the bias moves a receiver towards the light, along its light ray.

/// Cosine between the ray to the light and the view's axis, at least 1e-6: metres along the axis per metre along the ray.
float axis_per_ray(Receiver r) {
    if (LIGHT_WARPED[r.light] != 0) return 1.0;  // of parallel rays
    // The axis towards the light: perspective depth is the distance along it (w), other depth grows against it.
    mat4 m = view_of(r.layer).uvd_from_relative;
    vec3 axis = LIGHT_PERSPECTIVE[r.light] != 0 ? -vec3(m[0][3], m[1][3], m[2][3])
                                               : -away(1.0) * vec3(m[0][2], m[1][2], m[2][2]);
    return max(dot(r.to_light, axis) * inversesqrt(max(dot(axis, axis), 1e-37)), 1e-6);
}

/// Metres, of the geometric normal's slope: bias of the compared depth along the view's axis, and the normal offset's
/// share.
float bias_along_ray_m(Receiver r) {
    float along_axis_m = metres_towards_light(r, depth_bias(bias_input(r, r.geometric_n_dot_l, r.z)));
    return along_axis_m / axis_per_ray(r) + bias_normal * r.texel_m * r.geometric_n_dot_l;
}
