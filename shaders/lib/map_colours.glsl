// Colour ramps of the map viewer.

/// Turbo by a polynomial of fifth degree. Mikhailov, Turbo, An Improved Rainbow Colormap for Visualization, 2019.
vec3 turbo_colour(float t) {
    const vec3 c0 = vec3(0.13572138, 0.09140261, 0.10667330), c1 = vec3(4.61539260, 2.19418839, 12.64194608),
               c2 = vec3(-42.66032258, 4.84296658, -60.58204836), c3 = vec3(132.13108234, -14.18503333, 110.36276771),
               c4 = vec3(-152.94239396, 4.27729857, -89.90310912), c5 = vec3(59.28637943, 2.82956604, 27.34824973);
    return c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5))));
}

/// Viridis, interpolated between nine of its colours. Van der Walt and Smith, 2015.
vec3 viridis_colour(float t) {
    const vec3 stops[9] = vec3[](vec3(0.267, 0.005, 0.329), vec3(0.278, 0.176, 0.483), vec3(0.231, 0.318, 0.545),
                                 vec3(0.173, 0.443, 0.557), vec3(0.128, 0.567, 0.551), vec3(0.154, 0.681, 0.505),
                                 vec3(0.361, 0.786, 0.388), vec3(0.668, 0.862, 0.196), vec3(0.993, 0.906, 0.144));
    int stop = min(int(8.0 * t), 7);
    return mix(stops[stop], stops[stop + 1], 8.0 * t - float(stop));
}

/// @param colours view.map_colours @param t 0 to 1
vec3 map_colour(int colours, float t) {
    return clamp(colours == 1 ? turbo_colour(t) : colours == 2 ? viridis_colour(t) : vec3(t), 0.0, 1.0);
}
