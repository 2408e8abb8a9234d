// Variance of depths around the fragment by the map's moments. Below zero it is rounding error.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND || !faces_light(r)) return vec4(NOTHING);
    map_visibility(r);
    return vec4(found.variance);
}
