// Meshes of simple shapes, and functions that assemble a scene from them, for built-in scenes and tests. Lengths in
// metres; front faces are counter-clockwise seen from outside; texture coordinates in metres unless stated otherwise.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

// ---- Meshes, centred on the origin unless stated otherwise; their `material` is -1 -------------------------------

/// Makes a flat-shaded mesh of convex polygons. @param faces corners of each polygon, counter-clockwise from its front
Mesh make_polygons(std::string name, const std::vector<std::vector<glm::dvec3>>& faces);

/// Makes a closed box centred on the origin. @param size metres along x, y, z
Mesh make_box(const glm::dvec3& size);

/// Makes an open rectangle in the plane y = 0 that faces +y, divided into cells_x by cells_z cells.
Mesh make_plane(double size_x, double size_z, int cells_x = 1, int cells_z = 1);

/// Makes an open rectangle in the plane z = 0 that faces +z and stands on y = 0, with texture coordinates 0..1.
Mesh make_quad(double width, double height);

/// Makes a closed ramp on y = 0, `size.x` wide, rising from 0 at -x to `size.y` at +x.
Mesh make_wedge(const glm::dvec3& size);

/// A point on the outline of a surface of revolution about the y axis: distance from the axis, height, outward normal.
struct OutlinePoint {
    double radius = 0, y = 0;
    double normal_radius = 1, normal_y = 0;
};
/// Makes a surface of revolution about the y axis. It is closed when the outline starts and ends on the axis, or ends
/// on its first point.
/// @param outline the outline from top to bottom; a crease lists its point twice, with both normals
Mesh make_revolution(std::string name, const std::vector<OutlinePoint>& outline, int segments);

/// Makes a closed sphere around the origin. @param radius metres
Mesh make_sphere(double radius, int segments = 48, int rings = 24);
/// Makes a closed cylinder from y = 0 to `height`, or a truncated cone when `top_radius` is not negative.
Mesh make_cylinder(double radius, double height, int segments = 32, double top_radius = -1);
/// Makes a closed capsule around the upright segment from y = 0 to `length`.
Mesh make_capsule(double radius, double length, int segments = 24);
/// Makes a closed torus around the y axis.
Mesh make_torus(double ring_radius, double tube_radius, int segments = 64, int sides = 24);

/// Returns a mesh with all vertices transformed by `m` (normals by its cofactors).
Mesh transformed(Mesh mesh, const glm::dmat4& m);
/// Appends the triangles of `more` to `mesh`. Both have the same vertex attributes.
void append(Mesh& mesh, const Mesh& more);

// ---- Assembling a scene ----------------------------------------------------------------------------------

/// Returns the matrix of a translation, metres.
glm::dmat4 moved(double x, double y, double z);
/// Returns the matrix of a rotation about an axis, by an angle in degrees.
glm::dmat4 turned(double degrees, const glm::dvec3& axis = {0, 1, 0});
/// Returns the matrix of a scale.
glm::dmat4 scaled(double x, double y, double z);

/// Adds an opaque material of one colour to a scene. Returns its index.
int add_material(Scene& scene, std::string name, const glm::vec3& linear_colour);
/// Adds a mesh with a material (an index) to a scene, without placing it. Returns its index.
int add_mesh(Scene& scene, std::string name, Mesh mesh, int material);
/// Adds an empty node to a scene. Returns its index. @param parent node; -1: none @param local transform to the parent
int add_node(Scene& scene, std::string name, int parent = -1, const glm::dmat4& local = glm::dmat4(1));
/// Adds a node that places one mesh in a scene. Returns the node's index. @param parent node; -1: none
/// @param local transform to the parent
int add_object(Scene& scene, std::string name, int parent, int mesh, const glm::dmat4& local = glm::dmat4(1));
/// Adds a mesh with a material (an index) and a node of the same name that places it. Returns the node's index.
int add_shape(Scene& scene, const std::string& name, int parent, Mesh mesh, int material,
              const glm::dmat4& local = glm::dmat4(1));
/// Adds a perspective camera to a scene, at `eye`, looking at `target` with +y up.
void add_camera(Scene& scene, const glm::dvec3& eye, const glm::dvec3& target, double fov_y_deg);

/// Makes an empty scene with a name and a sentence about it.
Scene named_scene(std::string name, std::string about);
/// Returns a scene after finalise(). @param suggested suggested settings (key, value)
Scene finished(Scene scene, std::vector<std::pair<std::string, std::string>> suggested = {});
/// Pseudo-random generator with the same numbers on every machine (O'Neill, PCG, 2014: RXS M XS 32/32).
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(seed) { next(); }
    /// Returns the next 32 pseudo-random bits.
    std::uint32_t next();
    /// Returns a random number, uniform in [lo, hi).
    double in(double lo, double hi) { return lo + (hi - lo) * (next() * (1.0 / 4294967296.0)); }
    /// Returns a random unit vector, uniform on the sphere.
    glm::dvec3 direction();

private:
    std::uint32_t state_;
};

}  // namespace si
