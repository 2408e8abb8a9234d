// What the receiver's plane needs, in closed form, for all texels alike. After Dou, Yan, Kerzner, Dai, Wyman, Adaptive Depth
// Bias for Shadow Maps, JCGT 3(4), 2014, who take one texel's centre; here it is the chosen kernel's whole reach.
float depth_bias(BiasInput b) { return b.least_common; }
