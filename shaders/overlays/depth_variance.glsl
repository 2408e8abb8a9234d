// The variance of depths about the fragment by the map's moments; below zero rounding has eaten it.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND || !faces_light(r)) return vec4(NOTHING);
    map_visibility(r);
    return vec4(found.variance);
}
