// One nearest tap: the lectures' comparison of stored and own depth.
float filter_visibility(Receiver r) {
    vec3 at = vec3(r.uvd_offset.xy, r.layer);
#if FILTER_SAMPLER
    return texture(shadow_map_compare, vec4(at, r.reference));
#else
    return depth_test(r.reference, texture(shadow_map, at).r);
#endif
}
