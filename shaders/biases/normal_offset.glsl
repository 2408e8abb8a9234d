// Shift of the looked-up point along the normal, metres. Holbert, Saying Goodbye to Shadow Acne, GDC 2011.
vec3 normal_offset(vec3 normal, float texel_m) { return normal * (bias_normal * texel_m); }
