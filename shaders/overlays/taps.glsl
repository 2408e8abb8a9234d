// Texels that the kernel fetched for this fragment.
vec4 overlay(Receiver r) {
    if (r.where == NO_MAP) return vec4(NOTHING);
    if (!faces_light(r) || is_guarded(r)) return vec4(0.0);
    map_visibility(r);
    return vec4(isnan(found.taps) ? frame.pixel.z : found.taps);
}
