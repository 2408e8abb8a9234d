// The lectures' bias, as LearnOpenGL's chapter on shadow mapping has it: more where light grazes the surface, never less than the constant.
float depth_bias(BiasInput b) {
#if BIAS_SLOPED
    return unit_depth(b, max(bias_slope * (1.0 - clamp(b.n_dot_l, 0.0, 1.0)), bias_constant));
#else
    return unit_depth(b, bias_constant);
#endif
}
