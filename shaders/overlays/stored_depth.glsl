// The depth stored in the texel that the fragment falls into.
vec4 overlay(Receiver r) {
    if (r.where == BEHIND) return vec4(NOTHING);
    return vec4(texture(shadow_map, vec3(r.uvd.xy, r.layer)).r);
}
