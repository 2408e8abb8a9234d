// Own minus stored distance along the light's axis, metres: above zero something lies before the fragment.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    LightBlock light = frame.lights[r.light];
    bool perspective = LIGHT_PERSPECTIVE[r.light] != 0;
    float stored = map_depth(r.uvd.xy, r.layer);
    return vec4(metres_from_depth(r.uvd.z, light.curve.x, light.curve.y, perspective) -
                metres_from_depth(stored, light.curve.x, light.curve.y, perspective));
}
