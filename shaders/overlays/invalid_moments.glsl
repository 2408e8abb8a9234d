// Invalid moments that the kernel read. Red: moments of no distribution, with a variance or determinant below zero by
// rounding. Magenta: no numbers, since an exponential has overflowed.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND || !faces_light(r)) return vec4(0.0);
    map_visibility(r);
    if (isnan(found.bound) && isnan(found.own)) return vec4(0.0);  // the kernel reads no moments
    if (isinf(found.moments.x) || isnan(found.moments.x) || isnan(found.bound)) return vec4(1.0, 0.0, 1.0, 1.0);
    return found.margin < 0.0 ? vec4(0.9, 0.1, 0.1, 1.0) : vec4(0.0);
}
