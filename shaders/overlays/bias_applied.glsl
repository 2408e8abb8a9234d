// Total bias of the fragment in texels: depth bias plus the normal offset's part along the light.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    return vec4(texels_nearer(r, away_from_light(r.uvd.z - r.reference)));
}
