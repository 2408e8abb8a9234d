#include "renderer/scenes/hard_scenes.h"

#include <initializer_list>
#include <limits>

#include "renderer/scenes/shapes.h"

namespace si {
namespace {

constexpr double kFov = 45;
const glm::dvec3 kEye(-2.5, 7, 6.5), kTarget(0, 0.5, 0);

/// Makes a scene with an empty root node, a floor, and a camera that looks at the floor's centre.
Scene on_floor(double size = 10, const glm::dvec3& eye = kEye, const glm::dvec3& target = kTarget,
               const glm::dmat4& placed = glm::dmat4(1)) {
    Scene scene;
    const int root = add_node(scene, "Case", -1, placed);
    add_shape(scene, "Floor", root, make_plane(size, size), add_material(scene, "Grey", glm::vec3(0.6f)));
    add_camera(scene, glm::dvec3(placed * glm::dvec4(eye, 1)), glm::dvec3(placed * glm::dvec4(target, 1)), kFov);
    return scene;
}

/// A mesh of the scene's first material below its root node.
struct Body {
    const char* name;
    Mesh mesh;
    glm::dmat4 local;
};

/// Adds bodies to a scene and completes it.
Scene with_bodies(Scene scene, std::initializer_list<Body> bodies) {
    for (const Body& body : bodies) add_shape(scene, body.name, 0, body.mesh, 0, body.local);
    return finished(std::move(scene));
}

Scene box_under(const glm::dmat4& placed) {
    return with_bodies(on_floor(10, kEye, kTarget, placed), {{"Box", make_box({1.5, 1, 2}), moved(0, 0.75, 0)},
                                                             {"Ball", make_sphere(0.625, 24, 12), moved(-2, 1.5, 1)}});
}

Mesh box_turned(const glm::dvec3& size, double degrees, const glm::dvec3& axis = {0, 1, 0}) {
    return transformed(make_box(size), turned(degrees, axis));
}

}  // namespace

Scene hard_floor_and_box() {
    return box_under(glm::dmat4(1));
}

Scene hard_sphere() {
    return with_bodies(on_floor(6, {3.5, 2.5, 2.5}, {0, 1, 0}),
                       {{"Sphere", make_sphere(1, 96, 48), moved(0, 1.25, 0)}});
}

Scene hard_spot_floor() {
    return with_bodies(on_floor(10, {-2, 10, 4}, {0, 0, 0}), {{"Box", make_box({1.5, 1, 2}), moved(0, 0.75, 0)}});
}

Scene hard_plate_above() {
    return with_bodies(on_floor(), {{"Plate", make_plane(3, 3), moved(0, 1, 0)}});
}

Scene hard_wall() {
    return with_bodies(on_floor(20, {-6, 22, 8}, {0, 0, 0}), {{"Wall", make_box({3, 3, 0.25}), moved(0, 1.5, -4)}});
}

Scene hard_far_away() {
    return box_under(moved(1048576, -524288, 1048576));
}

Scene hard_tiny() {
    return box_under(scaled(0.01, 0.01, 0.01));
}

Scene hard_field() {
    Scene scene = on_floor(24, {-5, 5, 9}, {0, 0.5, 0});
    const int box = add_mesh(scene, "Box", box_turned({1, 1.5, 1}, 20), 0);
    for (int x = -2; x <= 2; ++x)
        for (int z = -2; z <= 2; ++z) add_object(scene, "Box", 0, box, moved(3 * x, 0.75, 3 * z));
    return finished(std::move(scene));
}

Scene hard_degenerate() {
    Scene scene = on_floor();
    Mesh box = make_box({1.5, 1, 2});
    const auto first = std::uint32_t(box.positions.size());
    for (const glm::vec3& p : {glm::vec3(0), {0.5f, 0.375f, 0.75f}, {-0.75f, 0.25f, 1}, {0.25f, 0.1875f, 0.375f}}) {
        box.positions.push_back(p);
        if (!box.normals.empty()) box.normals.push_back({0, 1, 0});
        if (!box.uv.empty()) box.uv.push_back({0, 0});
    }
    // A point, lines, and three points of one line.
    for (const std::uint32_t i : {0u, 0u, 0u, 1u, 1u, 2u, 2u, 1u, 2u, 0u, 3u, 1u}) box.indices.push_back(first + i);
    return with_bodies(std::move(scene), {{"Box", std::move(box), moved(0, 0.75, 0)}});
}

Scene hard_stretched() {
    Scene scene = on_floor(10, {-1, 6, 7}, {0, 0.5, 0});
    const int root = add_node(scene, "Stretched", 0, moved(0, 0.75, 0) * scaled(4, 0.5, 1));
    add_shape(scene, "Box", root, box_turned({1, 1, 1}, 30), 0);
    return finished(std::move(scene));
}

Scene hard_mirrored() {
    return with_bodies(box_under(scaled(-1, 1, 1)), {{"Plate", make_plane(3, 2), moved(2, 2, -1.5)}});
}

Scene hard_flattened() {
    Scene scene = box_under(glm::dmat4(1));
    const int box = add_mesh(scene, "Cube", make_box({1, 1, 1}), 0);
    add_object(scene, "Plate", 0, box, moved(2, 1, 1) * scaled(1, 0, 1));
    add_object(scene, "Point", 0, box, moved(1, 2, 1) * scaled(0, 0, 0));
    return finished(std::move(scene));
}

Scene hard_plate_on_floor() {
    return with_bodies(on_floor(10, {-2, 5, 4}, {0, 0, 0}), {{"Plate", make_plane(2, 2), moved(0, 1.0 / 64, 0)}});
}

Scene hard_wires() {
    Scene scene = on_floor(8, {-1.5, 3.5, 3}, {0, 0, 0});
    for (int i = -4; i <= 4; ++i)
        add_shape(scene, "Wire", 0, box_turned({1.0 / 128, 1.0 / 128, 4}, 10), 0, moved(0.375 * i, 0.75, 0));
    return with_bodies(std::move(scene), {{"Bar", box_turned({3.5, 0.125, 0.125}, 10), moved(0, 0.75, -1.75)}});
}

Scene hard_slope() {
    return with_bodies(on_floor(2, {0, 9, 9}, {0, 1.5, 0}),
                       {{"Slope", transformed(make_plane(10, 10), turned(20, {1, 0, 0})), moved(0, 2, 0)},
                        {"Bar", make_box({4, 0.25, 0.25}), moved(0, 3.5, 1)}});
}

Scene hard_two_covers() {
    return with_bodies(on_floor(10, {-2, 6, 7}, {0.5, 0, 0}), {{"High cover", make_plane(2, 4), moved(-1, 3, 0)},
                                                               {"Low cover", make_plane(4, 2), moved(0, 1, 0.5)}});
}

Scene hard_stairs() {
    Scene scene = on_floor(6, {-1, 5, 5.5}, {0, 1, 0});
    Mesh stairs;
    stairs.name = "Stairs";
    constexpr int kSteps = 40;
    constexpr double kStep = 1.0 / 16;
    for (int i = 0; i < kSteps; ++i) {
        Mesh tread = transformed(make_plane(4, kStep), moved(0, kStep * (i + 1), -kStep * (i + 0.5)));
        Mesh riser = transformed(make_quad(4, kStep), moved(0, kStep * i, -kStep * i));
        tread.uv.clear();
        riser.uv.clear();
        if (i == 0)
            stairs = std::move(tread);
        else
            append(stairs, tread);
        append(stairs, riser);
    }
    return with_bodies(std::move(scene), {{"Stairs", std::move(stairs), moved(0, 0, 1.25)}});
}

Scene hard_bar() {
    return with_bodies(on_floor(10, {-2, 12, 4}, {0, 0, 0}), {{"Bar", make_box({6, 1, 0.5}), moved(0, 0.75, 0)}});
}

Scene hard_lamp() {
    return with_bodies(on_floor(16, {-3, 10, 5}, {0, 0, 0}),
                       {{"Sheet", make_plane(2.5, 5), moved(2, 1, 0.25)},
                        {"Post", make_box({0.5, 2, 0.5}), moved(-2, 1, 2)},
                        {"Beam", make_box({0.5, 0.5, 5}), moved(-2.5, 1.25, -1.5)}});
}

Scene hard_high_sheet() {
    // One long triangle: clamping a vertex to the near plane would bend it.
    Mesh sheet;
    sheet.name = "Sheet";
    sheet.positions = {{-1.5f, 30, -1.5f}, {1.5f, 2, 3}, {2.5f, 30, -1.5f}};
    sheet.indices = {0, 1, 2};
    return with_bodies(on_floor(), {{"Sheet", std::move(sheet), glm::dmat4(1)}});
}

Scene hard_blended_sheet() {
    Scene scene = on_floor();
    Texture holes{.name = "Holes",
                  .width = 4,
                  .height = 4,
                  .wrap_s = TextureWrap::Clamp,
                  .wrap_t = TextureWrap::Clamp,
                  .nearest_mag = true,
                  .nearest_min = true,
                  .mipmaps = false};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) holes.rgba.append({220, 220, 220, std::uint8_t((x + y) % 2 ? 0 : 255)});
    scene.textures.push_back(std::move(holes));
    for (const AlphaMode alpha : {AlphaMode::Mask, AlphaMode::Blend}) {
        const bool mask = alpha == AlphaMode::Mask;
        const int material = add_material(scene, mask ? "Mask" : "Blend", glm::vec3(0.8f));
        scene.materials[std::size_t(material)].base_colour_texture = 0;
        scene.materials[std::size_t(material)].alpha = alpha;
        scene.materials[std::size_t(material)].double_sided = true;
        Mesh sheet = make_plane(3, 4);
        sheet.uv.clear();
        for (const glm::vec3& p : sheet.positions) sheet.uv.emplace_back(p.x / 3 + 0.5f, p.z / 4 + 0.5f);
        const char* name = mask ? "Mask" : "Blend";
        add_shape(scene, name, 0, std::move(sheet), material, moved(mask ? -1.75 : 1.75, 1, 0));
    }
    return finished(std::move(scene));
}

Scene hard_not_finite() {
    Mesh broken = make_box({1, 1, 1});
    broken.positions.edit()[0].x = std::numeric_limits<float>::quiet_NaN();
    broken.positions.edit()[1].y = std::numeric_limits<float>::infinity();
    return with_bodies(
        on_floor(), {{"Box", make_box({1.5, 1, 2}), moved(0, 0.75, 0)}, {"Broken", std::move(broken), moved(2, 1, 0)}});
}

Scene hard_many_vertices() {
    return with_bodies(on_floor(), {{"Plate", make_plane(4, 3, 260, 260), moved(0, 1.5, 0)}});
}

Scene hard_low_polygon() {
    return with_bodies(on_floor(6, {3.5, 2.5, 2.5}, {0, 1, 0}), {{"Ball", make_sphere(1, 10, 6), moved(0, 1.25, 0)}});
}

Scene hard_convex_bodies() {
    return with_bodies(on_floor(10, {-2.5, 6, 6.5}, {0, 0.5, 0}),
                       {{"Ball", make_sphere(0.75, 32, 16), moved(-2, 1, 0)},
                        {"Box", box_turned({1, 1, 1}, 25, glm::normalize(glm::dvec3(1, 2, 1))), moved(0, 1.25, 0)},
                        {"Cone", make_cylinder(0.75, 1.5, 24, 0.25), moved(2, 0.25, 0)}});
}

}  // namespace si
