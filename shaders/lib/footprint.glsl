// Pixel footprint in the shadow map, from the surface's plane. Screen derivatives would break at edges and do not exist in
// passes that draw no surfaces.

/// Returns the change of map coordinates over one pixel to the right and one upwards, on the receiver's plane.
mat2 pixel_footprint(Receiver r) {
    vec3 n = r.surface.geometric, axis = abs(n.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 along = normalize(cross(n, axis)), across = cross(n, along);
    mat4 seen = frame.clip_from_relative, held = view_of(r.layer).uvd_from_relative;
    // The quotient rule on both projections along two directions in the plane.
    vec4 clip = seen * vec4(r.surface.position, 1.0);
    vec4 clip_a = seen * vec4(along, 0.0), clip_b = seen * vec4(across, 0.0);
    vec2 size = 0.5 * frame.picture.xy / clip.w;
    mat2 pixels = mat2((clip_a.xy - clip.xy * (clip_a.w / clip.w)) * size, (clip_b.xy - clip.xy * (clip_b.w / clip.w)) * size);
    vec4 map_a = held * vec4(along, 0.0), map_b = held * vec4(across, 0.0);
    mat2 uvs = mat2((map_a.xy - r.uvd.xy * map_a.w) / r.w, (map_b.xy - r.uvd.xy * map_b.w) / r.w);
    float determinant_px = pixels[0].x * pixels[1].y - pixels[0].y * pixels[1].x;
    // Edge-on to the camera the footprint is unlimited, so it is clamped to the map.
    mat2 inverse_px = mat2(pixels[1].y, -pixels[0].y, -pixels[1].x, pixels[0].x);
    mat2 print = uvs * inverse_px;
    float least = max(max(abs(print[0].x), abs(print[0].y)), max(abs(print[1].x), abs(print[1].y)));
    float divisor = max(abs(determinant_px), least);
    return divisor > 0.0 ? print / (determinant_px < 0.0 ? -divisor : divisor) : mat2(0.0);
}
