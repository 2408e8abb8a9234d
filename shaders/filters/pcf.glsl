// Percentage-closer filtering with bilinear taps: the mean of KERNEL_SIZE^2 comparisons that each weigh 2x2 texels.
// Interior texels of the footprint weigh 1 and its border texels their bilinear share, so (KERNEL_SIZE + 1)^2 texels
// fetched by gathers give the same sum as KERNEL_SIZE^2 filtered taps.
float filter_visibility(Receiver r) {
    const int radius = KERNEL_SIZE / 2;
    float size = float(map_resolution), texel = 1.0 / size;
#if FILTER_SAMPLER
    float sum = 0.0;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            sum += map_compare_at(r.uvd_offset.xy + vec2(x, y) * texel, r.layer, r.reference);
    return sum / float(KERNEL_SIZE * KERNEL_SIZE);
#else
    vec2 at = r.uvd_offset.xy * size - 0.5;
    vec2 corner = floor(at), f = at - corner;
    float sum = 0.0;
    for (int y = 0; y <= KERNEL_SIZE; y += 2) {
        float y0 = y == 0 ? 1.0 - f.y : 1.0, y1 = y == KERNEL_SIZE - 1 ? f.y : 1.0;
        for (int x = 0; x <= KERNEL_SIZE; x += 2) {
            float x0 = x == 0 ? 1.0 - f.x : 1.0, x1 = x == KERNEL_SIZE - 1 ? f.x : 1.0;
            // Gathering where four texels meet keeps rounding from choosing a neighbouring quad.
            vec2 meet = (corner + vec2(x - radius + 1, y - radius + 1)) * texel;
            vec4 lit = gather_lit(r, meet);
            sum += dot(lit, vec4(x0 * y1, x1 * y1, x1 * y0, x0 * y0));
        }
    }
    return min(sum / float(KERNEL_SIZE * KERNEL_SIZE), 1.0);  // the weights round to a little more than one
#endif
}
