// Solid and flat shapes, and the few steps that put a scene together from them. Used by the built-in scenes and by
// tests. Lengths in metres; front faces are counter-clockwise seen from outside; texture coordinates are in metres
// unless said otherwise.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

// ---- Meshes, centred on the origin unless said otherwise; their `material` is -1 -------------------------------

/// Flat-shaded convex polygons; each is a list of corners, counter-clockwise from its front.
Mesh make_polygons(std::string name, const std::vector<std::vector<glm::dvec3>>& faces);

/// A box, closed.
Mesh make_box(const glm::dvec3& size);

/// A rectangle in the plane y = 0 that faces +y, cut into cells_x by cells_z cells. Open.
Mesh make_plane(double size_x, double size_z, int cells_x = 1, int cells_z = 1);

/// A rectangle in the plane z = 0 that faces +z, standing on y = 0, with texture coordinates 0..1. Open.
Mesh make_quad(double width, double height);

/// A ramp on y = 0, closed: `size.x` wide, rising from 0 at -x to `size.y` at +x.
Mesh make_wedge(const glm::dvec3& size);

/// A point of an outline that is turned about the y axis: its distance from the axis, height and outward normal.
struct OutlinePoint {
    double radius = 0, y = 0;
    double normal_radius = 1, normal_y = 0;
};
/// Turns an outline, listed from top to bottom with the outside away from the axis, about the y axis. Where the outline
/// has a crease, it lists the point twice. Closed when the outline starts and ends on the axis or on its own first
/// point.
Mesh make_revolution(std::string name, const std::vector<OutlinePoint>& outline, int segments);

Mesh make_sphere(double radius, int segments = 48, int rings = 24);
/// A cylinder, or a truncated cone when `top_radius` is not negative; from y = 0 to `height`, closed.
Mesh make_cylinder(double radius, double height, int segments = 32, double top_radius = -1);
/// Two half spheres around the ends of an upright segment from y = 0 to `length`, joined; closed.
Mesh make_capsule(double radius, double length, int segments = 24);
/// A ring around the y axis, closed.
Mesh make_torus(double ring_radius, double tube_radius, int segments = 64, int sides = 24);

/// The mesh with each vertex moved by `m` (normals by its cofactors).
Mesh transformed(Mesh mesh, const glm::dmat4& m);
/// Adds the triangles of `more` to `mesh`. Both have the same attributes.
void append(Mesh& mesh, const Mesh& more);

// ---- Putting a scene together ----------------------------------------------------------------------------------

glm::dmat4 moved(double x, double y, double z);
glm::dmat4 turned(double degrees, const glm::dvec3& axis = {0, 1, 0});
glm::dmat4 scaled(double x, double y, double z);

/// An opaque material of a linear colour. Returns its index.
int add_material(Scene& scene, std::string name, const glm::vec3& linear_colour);
/// Returns the mesh's index.
int add_mesh(Scene& scene, std::string name, Mesh mesh, int material);
/// Returns the node's index.
int add_node(Scene& scene, std::string name, int parent = -1, const glm::dmat4& local = glm::dmat4(1));
/// A node with one object. Returns the node's index.
int add_object(Scene& scene, std::string name, int parent, int mesh, const glm::dmat4& local = glm::dmat4(1));
/// A perspective camera at `eye` that looks at `target` with +y up.
void add_camera(Scene& scene, const glm::dvec3& eye, const glm::dvec3& target, double fov_y_deg);

/// A finalised scene of one mesh in grey, its node named after the mesh.
Scene make_scene(Mesh mesh, const glm::dmat4& local = glm::dmat4(1));

/// Pseudo-random numbers that are the same on every machine (O'Neill, PCG, 2014: the RXS M XS 32/32 generator).
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(seed) { next(); }
    std::uint32_t next();
    /// Uniform in [lo, hi).
    double in(double lo, double hi) { return lo + (hi - lo) * (next() * (1.0 / 4294967296.0)); }
    /// Uniform on the unit sphere.
    glm::dvec3 direction();

private:
    std::uint32_t state_;
};

}  // namespace si
