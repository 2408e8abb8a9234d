// Cosine between the triangle's normal and the direction to the light.
vec4 overlay(Receiver r) { return vec4(r.geometric_n_dot_l); }
