// The depth stored in the texel that the fragment falls into.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    return vec4(map_depth(r.uvd.xy, r.layer));
}
