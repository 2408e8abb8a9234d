// Percentage-closer filtering: the mean of KERNEL_SIZE^2 comparisons one texel apart, each with one texel or bilinearly
// with 2x2. Reeves, Salesin, Cook, Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987.
float filter_visibility(Receiver r) {
    vec2 size = MAP_SIZE, texel = 1.0 / size;
    float sum = 0.0;
#if FILTER_SAMPLER || !SAMPLER_BILINEAR
    const float middle = 0.5 * float(KERNEL_SIZE - 1);
    for (int y = 0; y < loop_bound(KERNEL_SIZE); ++y)
        for (int x = 0; x < KERNEL_SIZE; ++x)
            sum += compares_lit(r, r.uvd_offset.xy + (vec2(x, y) - middle) * texel);
    return sum / float(KERNEL_SIZE * KERNEL_SIZE);
#else
    // Interior texels of the footprint weigh 1 and its border texels their bilinear share, so (KERNEL_SIZE + 1)^2
    // texels fetched by gathers give the same sum as KERNEL_SIZE^2 filtered taps.
    vec2 at = r.uvd_offset.xy * size - 0.5 * float(KERNEL_SIZE % 2);
    vec2 corner = floor(at), f = at - corner;
    for (int y = 0; y <= loop_bound(KERNEL_SIZE); y += 2) {
        float y0 = y == 0 ? 1.0 - f.y : y == KERNEL_SIZE ? f.y : 1.0;
        float y1 = y == KERNEL_SIZE - 1 ? f.y : float(y < KERNEL_SIZE);
        for (int x = 0; x <= KERNEL_SIZE; x += 2) {
            float x0 = x == 0 ? 1.0 - f.x : x == KERNEL_SIZE ? f.x : 1.0;
            float x1 = x == KERNEL_SIZE - 1 ? f.x : float(x < KERNEL_SIZE);
            // Gathering where four texels meet keeps rounding from choosing a neighbouring quad.
            vec2 meet = (corner + vec2(x - KERNEL_SIZE / 2 + 1, y - KERNEL_SIZE / 2 + 1)) * texel;
            vec4 lit = gather_lit(r, meet);
            sum += dot(lit, vec4(x0 * y1, x1 * y1, x1 * y0, x0 * y0));
        }
    }
    return normalised_share(sum / float(KERNEL_SIZE * KERNEL_SIZE));
#endif
}
