// Map coordinates as red and green, with the map's texels as a checkerboard.
vec4 overlay(Receiver r) {
    if (r.where != INSIDE) return vec4(0.0);
    ivec2 texel = ivec2(floor(r.uvd.xy * MAP_SIZE));
    float check = ((texel.x + texel.y) & 1) == 0 ? 1.0 : 0.62;
    return vec4(vec3(r.uvd.xy, 0.25) * check, 1.0);
}
