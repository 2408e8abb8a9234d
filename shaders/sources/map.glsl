// Visibility from the light's shadow map by the chosen kernel. Williams, Casting Curved Shadows on Curved Surfaces, SIGGRAPH 1978.
float source_visibility(Surface s, int light) { return light_visibility(s, light); }
