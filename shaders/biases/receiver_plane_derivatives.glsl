// Comparison of every texel with the depth of the receiver's plane at the texel's centre. The plane comes from screen
// derivatives. Isidoro, Shadow Mapping: GPU-based Tips and Techniques, GDC 2006. Engines add one texel of the plane's slope
// for the error of derivatives (Pettineo, A Sampling of Shadow Techniques, 2013: fractional sampling error).
float depth_bias(BiasInput b) {
    float error = b.in_map ? rise_per_texel(b.gradient, 1.0) : 0.0;
    return unit_depth(b, bias_constant) + b.least_per_texel + error;
}

vec2 reference_slope(BiasInput b) { return b.gradient; }
