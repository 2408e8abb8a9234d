// The mean of 3x3 nearest comparisons with weights 1 2 1 along each axis.
// The binomial mask of second order: B. Jaehne, Digital Image Processing, chapter on averaging.
float filter_visibility(Receiver r) {
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec2 at = r.uvd_offset.xy + vec2(x, y) / MAP_SIZE;
            float weight = float((2 - abs(x)) * (2 - abs(y)));
            sum += weight * compares_lit(r, at);
        }
    return sum / 16.0;
}
