/// A unit vector at right angles to another.
vec3 across(vec3 n) { return normalize(abs(n.x) > abs(n.z) ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y)); }
