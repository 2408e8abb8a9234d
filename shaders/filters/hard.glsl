// One nearest tap: the lectures' comparison of stored and own depth.
float filter_visibility(Receiver r) {
#if FILTER_SAMPLER
    return map_compare_at(r.uvd_offset.xy, r.layer, r.reference);
#else
    return depth_test(r.reference, map_depth(r.uvd_offset.xy, r.layer));
#endif
}
