// Separable kernels by bilinear comparisons of 2x2 texels. The place of each comparison between its texels gives them the
// kernel's weights. Castano, Shadow Mapping
// Summary, on the shadows of The Witness, 2013. A kernel defines `float weight_of(float off)`, the weight of a
// texel whose centre is `off` texels away, before it includes this file.

const int PAIRS = KERNEL_SIZE / 2 + 1;  // pairs of the KERNEL_SIZE + 1 texels along an axis

/// Returns the weighted mean of the comparisons.
float paired_visibility(Receiver r) {
    float sum = 0.0;
    vec2 size = MAP_SIZE, at = r.uvd_offset.xy * size, first = floor(at - 0.5 * float(KERNEL_SIZE)), all = vec2(0.0);
    vec2 weights[2 * PAIRS];
    for (int i = 0; i < 2 * PAIRS; ++i) {
        vec2 off = first + float(i) + 0.5 - at;
        weights[i] = i <= KERNEL_SIZE ? vec2(weight_of(off.x), weight_of(off.y)) : vec2(0.0);
        all += weights[i];
    }
    for (int y = 0; y < PAIRS; ++y)
        for (int x = 0; x < PAIRS; ++x) {
            vec2 low = vec2(weights[2 * x].x, weights[2 * y].y), high = vec2(weights[2 * x + 1].x, weights[2 * y + 1].y);
            vec2 corner = first + vec2(2 * x, 2 * y);
#if FILTER_SAMPLER
            vec2 both = low + high, place = corner + 0.5 + high / max(both, vec2(1e-20));
            sum += both.x * both.y * map_compare_at(place / size, r.layer, r.reference);
#else
            vec4 lit = gather_lit(r, (corner + 1.0) / size);
            sum += dot(lit, vec4(low.x * high.y, high.x * high.y, high.x * low.y, low.x * low.y));
#endif
        }
    return normalised_share(sum / (all.x * all.y));
}
