// All bias that this fragment receives, in texels: along the light plus, of the normal offset, its part along the light.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    return vec4(texels_nearer(r, away(r.uvd.z - r.reference)));
}
