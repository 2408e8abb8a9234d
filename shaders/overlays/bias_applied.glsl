// All bias that this fragment receives, in texels: along the light plus, of the normal offset, its part along the light.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    float total_depth = away(r.uvd.z - r.reference);
    return vec4(total_depth / (r.depth_per_m * r.texel_m));
}
