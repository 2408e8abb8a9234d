// Colour scales of overlays.
#include "shared/colours.h"

vec3 three_stops(float t, vec3 low, vec3 middle, vec3 high) {
    t = clamp(t, 0.0, 1.0);
    return t < 0.5 ? mix(low, middle, t * 2.0) : mix(middle, high, t * 2.0 - 1.0);
}

vec3 sequential_colour(float t) {
    return three_stops(t, SEQUENTIAL_LOW, SEQUENTIAL_MIDDLE, SEQUENTIAL_HIGH);
}

vec3 diverging_colour(float t) {
    return three_stops(t, DIVERGING_LOW, DIVERGING_MIDDLE, DIVERGING_HIGH);
}
