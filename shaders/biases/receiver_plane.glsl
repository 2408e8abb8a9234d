// Every texel is compared with the depth of the receiver's plane at its centre. Isidoro, Shadow Mapping: GPU-based Tips
// and Techniques, GDC 2006, has the plane from screen derivatives; here it is the triangle's own, so neither edges nor
// small pixels break it. What is added is for roundings only.
float depth_bias(BiasInput b) { return unit_depth(b, bias_constant) + b.least_per_texel; }

vec2 reference_slope(BiasInput b) { return b.gradient; }
