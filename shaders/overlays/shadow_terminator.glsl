// Fragments whose triangle faces away from the light while their smooth normal faces it (magenta).
vec4 overlay(Receiver r) {
    bool smooth_lit = dot(r.surface.vertex, r.to_light) > FACES_AWAY_COSINE;
    return smooth_lit && !faces_light(r) && r.surface.receives ? vec4(0.8, 0.25, 0.7, 1.0) : vec4(0.0);
}
