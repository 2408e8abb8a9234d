// Width of the kernel's penumbra in texels, from the caster's distance and the light's size.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND || !faces_light(r)) return vec4(NOTHING);
    map_visibility(r);
    return vec4(found.penumbra_texels);
}
