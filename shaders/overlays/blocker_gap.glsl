// How far before the fragment the kernel took the occluder to be, along the light's axis.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND || !faces_light(r)) return vec4(NOTHING);
    map_visibility(r);
    return vec4(found.blocker_m);
}
