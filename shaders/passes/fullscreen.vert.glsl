// One triangle that covers the whole picture.
out vec2 picture_uv;

void main() {
    vec2 corner = vec2((gl_VertexID & 1) * 2, gl_VertexID & 2);
    picture_uv = corner;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
