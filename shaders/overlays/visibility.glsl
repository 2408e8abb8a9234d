// What the kernel found, 1 lit and 0 in shadow.
vec4 overlay(Receiver r) { return vec4(pixel_visibility(r)); }
