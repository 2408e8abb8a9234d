// Colour scales for numbers: readable with the common colour-vision deficiencies and in grey.

/// Perceptually ordered scale from dark blue to yellow; a polynomial in the spirit of Nunez, Anderton and Renslow's
/// cividis (PLoS ONE 13(7), 2018), fitted to its end points and middle.
vec3 sequential_colour(float t) {
    t = clamp(t, 0.0, 1.0);
    vec3 lo = vec3(0.00, 0.13, 0.30), mid = vec3(0.48, 0.48, 0.47), hi = vec3(0.99, 0.91, 0.27);
    return t < 0.5 ? mix(lo, mid, t * 2.0) : mix(mid, hi, t * 2.0 - 1.0);
}

/// Blue below zero, white at zero, orange above.
vec3 diverging_colour(float t) {
    t = clamp(t, 0.0, 1.0);
    vec3 lo = vec3(0.02, 0.28, 0.60), mid = vec3(0.96), hi = vec3(0.80, 0.33, 0.00);
    return t < 0.5 ? mix(lo, mid, t * 2.0) : mix(mid, hi, t * 2.0 - 1.0);
}
