// Comparison of every texel with the depth of the receiver's plane at the texel's centre, minus a remainder that grows with
// the texel's distance: surfaces bend, and the next triangle may rise above the plane. A rise by a texel's width per texel
// is allowed for, and an eighth of the plane's own slope. A plane that falls away from the light is not followed. Own
// formula, docs/accuracy.md; the plane is the one of biases/receiver_plane.glsl.

/// Returns the remainder per texel of distance, in depth-buffer units; 0 for a face that is not in the map.
float remainder_per_texel(BiasInput b) {
    if (!b.in_map) return 0.0;
    float width = depth_change_towards_light(b.perspective, b.nearest, b.own_z, b.depth_per_m, b.z, b.texel_m);
    return width + rise_per_texel(b.gradient, 0.125);
}

float depth_bias(BiasInput b) {
    return unit_depth(b, bias_constant) + b.least_per_texel + 0.5 * remainder_per_texel(b);
}

vec2 reference_slope(BiasInput b) { return b.gradient; }
