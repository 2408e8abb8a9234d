// Shift of the looked-up point along the normal, metres. Holbert, Saying Goodbye to Shadow Acne, GDC 2011.
// renderer/settings/biases.h has the same function in double precision.
vec3 normal_offset(vec3 normal, vec3 to_light, float texel_m) {
#if bias_normal_unit == bias_normal_unit_metres
    float whole = bias_normal;
#else
    float whole = bias_normal * texel_m;
#endif
#if bias_normal_by == bias_normal_by_sine
    return normal * (whole * length(cross(normal, to_light)));
#elif bias_normal_by == bias_normal_by_one_minus_cosine
    return normal * (whole * (1.0 - clamp(dot(normal, to_light), 0.0, 1.0)));
#elif bias_normal_by == bias_normal_by_sideways
    return (normal - to_light * dot(normal, to_light)) * whole;
#else
    return normal * whole;
#endif
}
