// Conversion of light to picture colours.

/// Encodes light as sRGB (IEC 61966-2-1), within a tenth of one of 255 steps. Above the linear part the curve is
/// 1.055 s^(5/6) - 0.055 of the root s, here a minimax polynomial of fifth degree. Values above 1 stay above 1.
vec3 srgb(vec3 c) {
    c = max(c, 0.0);
    vec3 s = sqrt(c);
    vec3 curve = ((((0.5173020 * s - 1.6236548) * s + 2.0315693) * s - 1.4027332) * s + 1.5179501) * s - 0.0401096;
    return mix(12.92 * c, curve, greaterThan(c, vec3(0.0031308)));
}

/// Encodes light by shading.curve. Filmic: a toe and a shoulder by a quotient of quadratics, sRGB included (form of Hejl and
/// Burgess-Dawson, 2010), scaled so that light of 4 is white and 0.18 is as in sRGB.
vec3 toned(vec3 c) {
#if CURVE_FILMIC
    vec3 x = max(0.8 * c - 0.004, 0.0);
    return x * (6.572 * x + 0.53) / (x * (6.2 * x + 1.7) + 0.06);
#else
    return srgb(c);
#endif
}
