/// Returns a unit vector perpendicular to the unit vector n.
vec3 perpendicular_to(vec3 n) { return normalize(abs(n.x) > abs(n.z) ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y)); }
