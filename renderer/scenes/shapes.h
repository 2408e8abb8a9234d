// Meshes of simple shapes, and functions that assemble a scene from them, for built-in scenes and tests. Lengths in
// metres; front faces are counter-clockwise seen from outside; texture coordinates in metres unless stated otherwise.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace si {

// ---- Meshes, centred on the origin unless stated otherwise; their `material` is -1 -------------------------------

/// Makes a flat-shaded mesh of convex polygons.
/// @param faces corners of each polygon, metres, counter-clockwise from its front
Mesh make_polygons(std::string name, const std::vector<std::vector<glm::dvec3>>& faces);

/// Makes a closed box centred on the origin. @param size metres along x, y, z
Mesh make_box(const glm::dvec3& size);

/// Makes an open rectangle in the plane y = 0, centred on the origin and facing +y. It is divided into cells_x by
/// cells_z cells. @param size_x, size_z metres
Mesh make_plane(double size_x, double size_z, int cells_x = 1, int cells_z = 1);

/// Makes an open rectangle in the plane z = 0 that faces +z and stands on y = 0. Texture coordinates run over 0..1.
/// @param width, height metres
Mesh make_quad(double width, double height);

/// Makes a closed ramp that stands on y = 0 and rises from 0 at -x to its full height at +x. @param size metres along
/// x, y, z
Mesh make_wedge(const glm::dvec3& size);

/// Point on the outline of a surface of revolution about the y axis: distance from the axis, height, outward normal.
struct OutlinePoint {
    double radius = 0, y = 0;
    double normal_radius = 1, normal_y = 0;
};
/// Makes a surface of revolution about the y axis. The surface is closed when the outline starts and ends on the axis,
/// or ends on its first point.
/// @param outline the outline from top to bottom; a crease lists its point twice, with both normals
/// @param segments divisions of the full turn
Mesh make_revolution(std::string name, const std::vector<OutlinePoint>& outline, int segments);

/// Makes a closed sphere around the origin.
/// @param radius metres @param segments divisions around the y axis @param rings divisions from pole to pole
Mesh make_sphere(double radius, int segments = 48, int rings = 24);
/// Makes a closed cylinder from y = 0 to `height`. A `top_radius` of 0 or more makes it a cone or truncated cone.
/// @param radius, height metres @param segments divisions of the full turn
Mesh make_cylinder(double radius, double height, int segments = 32, double top_radius = -1);
/// Makes a closed capsule: all points within `radius` of the upright segment from y = 0 to `length`.
/// @param radius, length metres @param segments divisions of the full turn
Mesh make_capsule(double radius, double length, int segments = 24);
/// Makes a closed torus around the y axis.
/// @param ring_radius metres from the axis to the middle of the tube @param tube_radius metres
/// @param segments divisions around the axis @param sides divisions around the tube
Mesh make_torus(double ring_radius, double tube_radius, int segments = 64, int sides = 24);

/// Returns a copy of a mesh with all positions transformed by `m`, and normals by the cofactor matrix of `m`.
Mesh transformed(Mesh mesh, const glm::dmat4& m);
/// Appends the vertices and triangles of `more` to `mesh`. Both must have the same vertex attributes.
void append(Mesh& mesh, const Mesh& more);

// ---- Assembling a scene ----------------------------------------------------------------------------------

/// Returns the matrix of a translation, to place a shape. @param x, y, z metres
glm::dmat4 moved(double x, double y, double z);
/// Returns the matrix of a rotation about an axis, by an angle in degrees.
glm::dmat4 turned(double degrees, const glm::dvec3& axis = {0, 1, 0});
/// Returns the matrix of a scale, to place a shape.
glm::dmat4 scaled(double x, double y, double z);

/// Adds an opaque material of one colour to a scene. Returns its index in Scene::materials.
int add_material(Scene& scene, std::string name, const glm::vec3& linear_colour);
/// Adds a mesh to a scene, without an object that shows it. Returns its index in Scene::meshes.
/// @param material index in Scene::materials
int add_mesh(Scene& scene, std::string name, Mesh mesh, int material);
/// Adds a node without a mesh to a scene. Returns its index in Scene::nodes.
/// @param parent index of the parent node; -1: none @param local transform to the parent
int add_node(Scene& scene, std::string name, int parent = -1, const glm::dmat4& local = glm::dmat4(1));
/// Adds a node, and an object that shows a mesh at this node, to a scene. Returns the index of the node.
/// @param parent index of the parent node; -1: none @param mesh index in Scene::meshes @param local transform to the
/// parent
int add_object(Scene& scene, std::string name, int parent, int mesh, const glm::dmat4& local = glm::dmat4(1));
/// Adds a mesh to a scene, with a node of the same name and an object that shows the mesh there. Returns the index of
/// the node.
/// @param parent index of the parent node; -1: none @param material index in Scene::materials
/// @param local transform to the parent
int add_shape(Scene& scene, const std::string& name, int parent, Mesh mesh, int material,
              const glm::dmat4& local = glm::dmat4(1));
/// Adds a perspective camera to a scene, at `eye`, looking at `target` with +y up.
/// @param fov_y_deg vertical field of view, degrees
void add_camera(Scene& scene, const glm::dvec3& eye, const glm::dvec3& target, double fov_y_deg);

/// Makes an empty scene, to be filled by add_shape() and others. @param about description in a sentence
Scene named_scene(std::string name, std::string about);
/// Sets the suggested settings of a scene, completes it by finalise() and set_main_part(), and returns it.
/// @param suggested pairs of setting key and value
Scene finished(Scene scene, std::vector<std::pair<std::string, std::string>> suggested = {});
/// Pseudo-random generator for built-in scenes, with the same numbers on every machine (O'Neill, PCG, 2014: RXS M XS
/// 32/32).
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(seed) { next(); }
    /// Returns the next 32 pseudo-random bits of this generator.
    std::uint32_t next();
    /// Returns a random number, uniform in [lo, hi).
    double in(double lo, double hi) { return lo + (hi - lo) * (next() * (1.0 / 4294967296.0)); }
    /// Returns a random unit vector, uniformly distributed on the sphere.
    glm::dvec3 direction();

private:
    std::uint32_t state_;
};

}  // namespace si
