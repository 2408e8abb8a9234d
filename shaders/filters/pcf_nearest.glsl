// Percentage-closer filtering by hand: the mean of KERNEL_SIZE^2 nearest taps, one texel apart.
// Reeves, Salesin, Cook, Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987.
float filter_visibility(Receiver r) {
    const int radius = KERNEL_SIZE / 2;
    float step_uv = 1.0 / float(map_resolution);
    float sum = 0.0;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) sum += compares_lit(r, r.uvd_offset.xy + vec2(x, y) * step_uv);
    return sum / float(KERNEL_SIZE * KERNEL_SIZE);
}
