// Shadow texels that one pixel spans along its widest direction: the larger singular value of d(texel)/d(pixel).
// Above 1 the map is finer than the picture, below 1 its texels show.
vec4 overlay(Receiver r) {
    if (r.where >= BEHIND) return vec4(NOTHING);
    mat4 m = frame.uvd_from_relative[r.layer];
    // The quotient rule on uv = h.xy / h.w, along the surface's own screen derivatives.
    vec4 hx = m * vec4(dFdx(r.surface.position), 0.0), hy = m * vec4(dFdy(r.surface.position), 0.0);
    vec2 jx = (hx.xy - r.uvd.xy * hx.w) / r.w * float(map_resolution);
    vec2 jy = (hy.xy - r.uvd.xy * hy.w) / r.w * float(map_resolution);
    float a = dot(jx, jx), b = dot(jx, jy), c = dot(jy, jy);
    return vec4(sqrt(0.5 * (a + c + sqrt((a - c) * (a - c) + 4.0 * b * b))));
}
