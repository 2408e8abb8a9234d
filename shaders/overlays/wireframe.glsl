// Colour of the edges of triangles.
vec4 overlay(Receiver r) { return vec4(0.02, 0.05, 0.10, 0.9); }
