// Mean distance of casters before the fragment by the kernel's blocker search, metres along the light's axis.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND || !faces_light(r)) return vec4(NOTHING);
    map_visibility(r);
    return vec4(found.blocker_m);
}
