/// Returns the texels per pixel along the densest and the sparsest direction in the picture: the singular values of
/// d(texel)/d(pixel), the larger one first.
vec2 texels_per_pixel(Receiver r) {
    mat4 m = view_of(r.layer).uvd_from_relative;
    // Quotient rule on uv = h.xy / h.w, along screen derivatives of the surface.
    vec4 hx = m * vec4(dFdx(r.surface.position), 0.0), hy = m * vec4(dFdy(r.surface.position), 0.0);
    vec2 jx = (hx.xy - r.uvd.xy * hx.w) / r.w * MAP_SIZE;
    vec2 jy = (hy.xy - r.uvd.xy * hy.w) / r.w * MAP_SIZE;
    float a = dot(jx, jx), b = dot(jx, jy), c = dot(jy, jy);
    float larger = sqrt(0.5 * (a + c + sqrt((a - c) * (a - c) + 4.0 * b * b)));
    // The product of both is the determinant, which is more precise than a difference of squares.
    return vec2(larger, larger > 0.0 ? abs(jx.x * jy.y - jx.y * jy.x) / larger : 0.0);
}
