// One nearest tap: comparison of stored and own depth. Williams, Casting Curved Shadows on Curved
// Surfaces, SIGGRAPH 1978.
float filter_visibility(Receiver r) { return compares_lit(r, r.uvd_offset.xy); }
