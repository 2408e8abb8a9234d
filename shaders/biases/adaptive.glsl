// Needed depth bias of the receiver's plane in closed form, equal for all texels. Source: Dou, Yan, Kerzner, Dai, Wyman,
// Adaptive Depth Bias for Shadow Maps, JCGT 3(4), 2014, for one texel's centre; here for the kernel's whole reach.
float depth_bias(BiasInput b) { return b.least_common; }
