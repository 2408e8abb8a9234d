// Plane that fills the viewport. Depth in the middle is plane.z; at the right and upper edge it is larger by plane.xy.
uniform vec3 plane;

void main() {
    vec2 at = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
    gl_Position = vec4(at, plane.z + dot(plane.xy, at), 1.0);
}
