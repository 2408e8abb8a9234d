// The shading normal, each axis from -1..1 to 0..1.
vec4 overlay(Receiver r) { return vec4(r.surface.shading * 0.5 + 0.5, 1.0); }
