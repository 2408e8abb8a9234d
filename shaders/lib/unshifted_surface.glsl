// Surface of a blended fragment where the pixel's ray meets its plane without the shift of smoothing's camera.
uniform vec2 camera_shift_ndc;  // shift of the picture, normalised device coordinates

/// Returns the surface moved along its plane to the place that the static picture shows at this pixel. Edges are taken as
/// drawn.
Surface unshifted_surface(Surface s) {
    mat4 m = frame.clip_from_relative;
    vec4 along = vec4(m[0][3], m[1][3], m[2][3], m[3][3]);
    float w = dot(along, vec4(s.position, 1.0));
    // The planes of the static camera through the pixel's column and row, of which the fragment lies aside.
    vec2 shifted = vec2(dot(vec4(m[0][0], m[1][0], m[2][0], m[3][0]), vec4(s.position, 1.0)),
                        dot(vec4(m[0][1], m[1][1], m[2][1], m[3][1]), vec4(s.position, 1.0))) / w;
    vec2 still = shifted + camera_shift_ndc;
    vec3 column = vec3(m[0][0], m[1][0], m[2][0]) - still.x * along.xyz;
    vec3 row = vec3(m[0][1], m[1][1], m[2][1]) - still.y * along.xyz;
    vec3 across = cross(row, s.geometric);
    float volume = dot(column, across);
    if (volume != 0.0)
        s.position += w / volume * (camera_shift_ndc.x * across + camera_shift_ndc.y * cross(s.geometric, column));
    return s;
}
