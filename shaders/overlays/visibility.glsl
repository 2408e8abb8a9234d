// Drawn visibility: 1 lit, 0 in shadow.
vec4 overlay(Receiver r) { return vec4(pixel_visibility(r)); }
