// Constant bias for every surface. Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978.
float depth_bias(BiasInput b) { return unit_depth(b, bias_constant); }
