// One nearest tap: the lectures' comparison of stored and own depth.
float filter_visibility(Receiver r) { return compares_lit(r, r.uvd_offset.xy); }
