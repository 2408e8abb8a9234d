// Every texel is compared with the receiver's plane at its centre, which is taken from screen derivatives. Isidoro, Shadow
// Mapping: GPU-based Tips and Techniques, GDC 2006. A texel of the plane's slope more is what engines add for what
// derivatives miss (Pettineo, A Sampling of Shadow Techniques, 2013: fractional sampling error).
float depth_bias(BiasInput b) {
    return unit_depth(b, bias_constant) + b.least_per_texel + (abs(b.gradient.x) + abs(b.gradient.y)) / float(map_resolution);
}

vec2 reference_slope(BiasInput b) { return b.gradient; }
