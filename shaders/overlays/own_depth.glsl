// The fragment's own depth in the light's clip space, before any bias.
vec4 overlay(Receiver r) { return r.where >= BEHIND ? vec4(NOTHING) : vec4(r.uvd.z); }
