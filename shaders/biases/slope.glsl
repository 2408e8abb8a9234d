// Slope-scaled bias of the lectures and of LearnOpenGL's chapter on shadow mapping: larger in grazing light, at least the
// constant.
float depth_bias(BiasInput b) {
#if BIAS_SLOPED
    return unit_depth(b, max(bias_slope * (1.0 - clamp(b.n_dot_l, 0.0, 1.0)), bias_constant));
#else
    return unit_depth(b, bias_constant);
#endif
}
