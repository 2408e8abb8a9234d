#include "renderer/scenes/shapes.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "renderer/scene/main_part.h"

namespace si {
namespace {

constexpr double kPi = std::numbers::pi;

std::uint32_t add_vertex(Mesh& mesh, const glm::dvec3& p, const glm::dvec3& n, const glm::dvec2& uv) {
    mesh.positions.emplace_back(p);
    mesh.normals.emplace_back(n);
    mesh.uv.emplace_back(uv);
    return std::uint32_t(mesh.positions.size() - 1);
}

/// Adds a triangle unless two of its corners are the same point, as they are at the poles.
void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
    if (p == q || q == r || r == p) return;
    mesh.indices.append({a, b, c});
}

/// Appends points on an arc of an outline, from angle `from` to `to` (radians, pi/2 is the top). The poles are exact.
void add_arc(std::vector<OutlinePoint>& outline, double centre_y, double radius, double from, double to, int steps) {
    for (int i = 0; i <= steps; ++i) {
        const double angle = from + (to - from) * i / steps;
        const bool pole = std::abs(std::abs(angle) - kPi / 2) < 1e-9;
        const double c = pole ? 0 : std::cos(angle), s = pole ? std::copysign(1.0, angle) : std::sin(angle);
        outline.push_back({radius * c, centre_y + radius * s, c, s});
    }
}

}  // namespace

Mesh make_polygons(std::string name, const std::vector<std::vector<glm::dvec3>>& faces) {
    Mesh mesh;
    mesh.name = std::move(name);
    for (const auto& face : faces) {
        const glm::dvec3 n = glm::normalize(glm::cross(face[1] - face[0], face[2] - face[0]));
        const glm::dvec3 along = glm::normalize(face[1] - face[0]), up = glm::cross(n, along);
        std::uint32_t first = 0, previous = 0;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const glm::dvec3 d = face[i] - face[0];
            const std::uint32_t index = add_vertex(mesh, face[i], n, {glm::dot(d, along), -glm::dot(d, up)});
            if (i == 0) first = index;
            if (i >= 2) add_triangle(mesh, first, previous, index);
            previous = index;
        }
    }
    return mesh;
}

Mesh make_box(const glm::dvec3& size) {
    const glm::dvec3 h = 0.5 * size;
    const auto p = [&](int x, int y, int z) { return glm::dvec3(x, y, z) * h; };
    return make_polygons("box", {{p(-1, -1, 1), p(1, -1, 1), p(1, 1, 1), p(-1, 1, 1)},
                                 {p(1, -1, -1), p(-1, -1, -1), p(-1, 1, -1), p(1, 1, -1)},
                                 {p(1, -1, 1), p(1, -1, -1), p(1, 1, -1), p(1, 1, 1)},
                                 {p(-1, -1, -1), p(-1, -1, 1), p(-1, 1, 1), p(-1, 1, -1)},
                                 {p(-1, 1, 1), p(1, 1, 1), p(1, 1, -1), p(-1, 1, -1)},
                                 {p(-1, -1, -1), p(1, -1, -1), p(1, -1, 1), p(-1, -1, 1)}});
}

Mesh make_plane(double size_x, double size_z, int cells_x, int cells_z) {
    Mesh mesh;
    mesh.name = "plane";
    for (int j = 0; j <= cells_z; ++j)
        for (int i = 0; i <= cells_x; ++i) {
            const double x = size_x * (double(i) / cells_x - 0.5), z = size_z * (double(j) / cells_z - 0.5);
            const std::uint32_t v = add_vertex(mesh, {x, 0, z}, {0, 1, 0}, {x, z});
            if (i == 0 || j == 0) continue;
            const std::uint32_t above = v - std::uint32_t(cells_x) - 1;
            add_triangle(mesh, above - 1, v - 1, v);
            add_triangle(mesh, above - 1, v, above);
        }
    return mesh;
}

Mesh make_quad(double width, double height) {
    Mesh mesh;
    mesh.name = "quad";
    for (int i = 0; i < 4; ++i) {
        const double u = (i == 1 || i == 2), v = i >= 2;
        add_vertex(mesh, {width * (u - 0.5), height * v, 0}, {0, 0, 1}, {u, 1 - v});
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Mesh make_wedge(const glm::dvec3& size) {
    const double x = 0.5 * size.x, z = 0.5 * size.z;
    const glm::dvec3 a(-x, 0, z), b(x, 0, z), c(x, size.y, z), d(-x, 0, -z), e(x, 0, -z), f(x, size.y, -z);
    return make_polygons("wedge", {{a, b, c}, {e, d, f}, {b, e, f, c}, {a, c, f, d}, {a, d, e, b}});
}

Mesh make_revolution(std::string name, const std::vector<OutlinePoint>& outline, int segments) {
    Mesh mesh;
    mesh.name = std::move(name);
    double widest = 0;
    for (const OutlinePoint& p : outline) widest = std::max(widest, p.radius);
    double along = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const OutlinePoint& p = outline[i];
        if (i > 0) along += std::hypot(p.radius - outline[i - 1].radius, p.y - outline[i - 1].y);
        for (int j = 0; j <= segments; ++j) {
            // The last column repeats the first exactly, so that the seam is watertight.
            const double angle = 2 * kPi * (j % segments) / segments, s = std::sin(angle), c = std::cos(angle);
            const std::uint32_t v = add_vertex(mesh, {p.radius * s, p.y, p.radius * c},
                                               {p.normal_radius * s, p.normal_y, p.normal_radius * c},
                                               {2 * kPi * widest * j / segments, along});
            if (i == 0 || j == 0) continue;
            const std::uint32_t above = v - std::uint32_t(segments) - 1;
            add_triangle(mesh, above - 1, v - 1, v);
            add_triangle(mesh, above - 1, v, above);
        }
    }
    return mesh;
}

Mesh make_sphere(double radius, int segments, int rings) {
    std::vector<OutlinePoint> outline;
    add_arc(outline, 0, radius, kPi / 2, -kPi / 2, rings);
    return make_revolution("sphere", outline, segments);
}

Mesh make_cylinder(double radius, double height, int segments, double top_radius) {
    const double top = top_radius < 0 ? radius : top_radius;
    const double side = std::hypot(height, radius - top), nr = height / side, ny = (radius - top) / side;
    return make_revolution("cylinder",
                           {{0, height, 0, 1},
                            {top, height, 0, 1},
                            {top, height, nr, ny},
                            {radius, 0, nr, ny},
                            {radius, 0, 0, -1},
                            {0, 0, 0, -1}},
                           segments);
}

Mesh make_capsule(double radius, double length, int segments) {
    std::vector<OutlinePoint> outline;
    add_arc(outline, length, radius, kPi / 2, 0, segments / 4);
    add_arc(outline, 0, radius, 0, -kPi / 2, segments / 4);
    return make_revolution("capsule", outline, segments);
}

Mesh make_torus(double ring_radius, double tube_radius, int segments, int sides) {
    std::vector<OutlinePoint> outline;
    for (int i = 0; i <= sides; ++i) {
        const double angle = -2 * kPi * (i % sides) / sides, c = std::cos(angle), s = std::sin(angle);
        outline.push_back({ring_radius + tube_radius * c, tube_radius * s, c, s});
    }
    return make_revolution("torus", outline, segments);
}

Mesh transformed(Mesh mesh, const glm::dmat4& m) {
    const glm::dmat3 a(m);
    // Cofactors carry normals through non-uniform scale without a division.
    const glm::dmat3 cofactors(glm::cross(a[1], a[2]), glm::cross(a[2], a[0]), glm::cross(a[0], a[1]));
    for (glm::vec3& p : mesh.positions.edit()) p = glm::vec3(m * glm::dvec4(p, 1));
    for (glm::vec3& n : mesh.normals.edit()) n = glm::vec3(glm::normalize(cofactors * glm::dvec3(n)));
    return mesh;
}

void append(Mesh& mesh, const Mesh& more) {
    const auto base = std::uint32_t(mesh.positions.size());
    for_each_attribute([&](auto attribute) { (mesh.*attribute).append(more.*attribute); });
    for (std::uint32_t index : more.indices) mesh.indices.push_back(base + index);
}

glm::dmat4 moved(double x, double y, double z) {
    return glm::translate(glm::dmat4(1), glm::dvec3(x, y, z));
}
glm::dmat4 turned(double degrees, const glm::dvec3& axis) {
    return glm::rotate(glm::dmat4(1), glm::radians(degrees), axis);
}
glm::dmat4 scaled(double x, double y, double z) {
    return glm::scale(glm::dmat4(1), glm::dvec3(x, y, z));
}

int add_material(Scene& scene, std::string name, const glm::vec3& linear_colour) {
    Material material;
    material.name = std::move(name);
    material.base_colour = glm::vec4(linear_colour, 1.0f);
    scene.materials.push_back(std::move(material));
    return int(scene.materials.size()) - 1;
}

int add_mesh(Scene& scene, std::string name, Mesh mesh, int material) {
    mesh.name = std::move(name);
    mesh.material = material;
    scene.meshes.push_back(std::move(mesh));
    return int(scene.meshes.size()) - 1;
}

int add_node(Scene& scene, std::string name, int parent, const glm::dmat4& local) {
    Node node;
    node.name = std::move(name);
    node.parent = parent;
    node.local = local;
    scene.nodes.push_back(std::move(node));
    return int(scene.nodes.size()) - 1;
}

int add_object(Scene& scene, std::string name, int parent, int mesh, const glm::dmat4& local) {
    const int node = add_node(scene, std::move(name), parent, local);
    Object object;
    object.node = node;
    object.mesh = mesh;
    scene.objects.push_back(object);
    return node;
}

int add_shape(Scene& scene, const std::string& name, int parent, Mesh mesh, int material, const glm::dmat4& local) {
    return add_object(scene, name, parent, add_mesh(scene, name, std::move(mesh), material), local);
}

void add_camera(Scene& scene, const glm::dvec3& eye, const glm::dvec3& target, double fov_y_deg) {
    const glm::dvec3 back = glm::normalize(eye - target);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)), up = glm::cross(back, right);
    SceneCamera camera;
    camera.name = "Camera";
    camera.world = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(back, 0), glm::dvec4(eye, 1));
    camera.fov_y_deg = fov_y_deg;
    scene.cameras.push_back(camera);
}

Scene named_scene(std::string name, std::string about) {
    Scene scene;
    scene.name = std::move(name);
    scene.about = std::move(about);
    return scene;
}

Scene finished(Scene scene, std::vector<std::pair<std::string, std::string>> suggested) {
    scene.suggested = std::move(suggested);
    finalise(scene);
    set_main_part(scene);
    return scene;
}

std::uint32_t Random::next() {
    state_ = state_ * 747796405u + 2891336453u;
    const std::uint32_t word = ((state_ >> ((state_ >> 28u) + 4u)) ^ state_) * 277803737u;
    return (word >> 22u) ^ word;
}

glm::dvec3 Random::direction() {
    const double y = in(-1, 1), angle = in(0, 2 * kPi), r = std::sqrt(1 - y * y);
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

}  // namespace si
