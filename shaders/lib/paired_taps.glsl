// Kernels whose weights are a product of one along each axis, by bilinear comparisons that take two texels of a row and
// two of a column each: placed between them, a comparison weighs the two as the kernel does. Castano, Shadow Mapping
// Summary, on the shadows of The Witness, 2013. A kernel defines `float weight_of(float off)` of a texel whose centre
// lies so many texels off, before it includes this.

const int PAIRS = KERNEL_SIZE / 2 + 1;  // of the KERNEL_SIZE + 1 texels that the kernel touches along an axis

/// Sums the comparisons with weights that are scaled to one.
float paired_visibility(Receiver r) {
    float size = float(map_resolution), sum = 0.0;
    vec2 at = r.uvd_offset.xy * size, first = floor(at - 0.5 * float(KERNEL_SIZE)), all = vec2(0.0);
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
