// Corners of the fragment's triangle, from the scene's buffers.
layout(std430, binding = STORAGE_SCENE_POSITIONS) readonly buffer ScenePositions { float scene_positions[]; };
layout(std430, binding = STORAGE_SCENE_INDICES) readonly buffer SceneIndices { uint scene_indices[]; };
flat in vec4 world_row0, world_row1, world_row2;
uniform ivec3 triangle_source;  // of the draw: first index, base vertex, number of triangles

/// Returns a corner of the triangle, relative to the frame's origin. @param k 0 to 2
vec3 triangle_corner(int k) {
    // Drivers may continue to count triangles over the instances of a draw.
    int i = triangle_source.x + 3 * (gl_PrimitiveID % triangle_source.z) + k;
    int v = 3 * (triangle_source.y + int(scene_indices[i]));
    vec4 p = vec4(scene_positions[v], scene_positions[v + 1], scene_positions[v + 2], 1.0);
    return vec3(dot(world_row0, p), dot(world_row1, p), dot(world_row2, p));
}
