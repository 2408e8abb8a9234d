// Comparison of every texel with the depth of the receiver's plane at the texel's centre. Isidoro, Shadow Mapping:
// GPU-based Tips and Techniques, GDC 2006, takes the plane from screen derivatives. Here the plane is the triangle's own,
// so neither edges nor small pixels break it. The added bias covers rounding only.
float depth_bias(BiasInput b) { return unit_depth(b, bias_constant) + b.least_per_texel; }

vec2 reference_slope(BiasInput b) { return b.gradient; }
