// From light to what is shown.

/// Encoded as sRGB (IEC 61966-2-1), within a tenth of one of 255 steps: above the linear part the curve is 1.055 s^(5/6) - 0.055 of
/// the root s, of which a polynomial of fifth degree has the least largest error; it
/// rises beyond 1, where what is drawn into holds it.
vec3 srgb(vec3 c) {
    c = max(c, 0.0);
    vec3 s = sqrt(c);
    vec3 curve = ((((0.5173020 * s - 1.6236548) * s + 2.0315693) * s - 1.4027332) * s + 1.5179501) * s - 0.0401096;
    return mix(12.92 * c, curve, greaterThan(c, vec3(0.0031308)));
}

/// Encoded by shading.curve. Filmic: a toe and a shoulder by the quotient of two squares, encoding included (the form is
/// Hejl and Burgess-Dawson's, 2010), scaled so that light of 4 is white; 0.18 stays where sRGB has it.
vec3 toned(vec3 c) {
#if CURVE_FILMIC
    vec3 x = max(0.8 * c - 0.004, 0.0);
    return x * (6.572 * x + 0.53) / (x * (6.2 * x + 1.7) + 0.06);
#else
    return srgb(c);
#endif
}
