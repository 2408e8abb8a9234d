// Two kilometres of land with a village: at this size one shadow map has texels as large as a door.
#include <fmt/format.h>

#include <cmath>

#include "renderer/scenes/makers.h"
#include "renderer/scenes/shapes.h"
#include "renderer/scenes/terrain.h"

namespace si {
namespace {

/// Sets the colour of all vertices and removes the texture coordinates, which this scene does not use.
Mesh tinted(Mesh mesh, const glm::vec3& colour) {
    mesh.colours.assign(mesh.positions.size(), glm::vec4(colour, 1));
    mesh.uv.clear();
    return mesh;
}

Mesh make_conifer() {
    Mesh tree = tinted(make_cylinder(0.22, 2.4, 8), {0.14f, 0.09f, 0.06f});
    const glm::vec3 needles(0.055f, 0.11f, 0.055f);
    for (int i = 0; i < 3; ++i)
        append(tree,
               tinted(transformed(make_cylinder(2.3 - 0.6 * i, 4.4 - 0.5 * i, 10, 0.02), moved(0, 1.6 + 2.4 * i, 0)),
                      needles * (1.0f + 0.18f * float(i))));
    return tree;
}

Mesh make_broadleaf() {
    Mesh tree = tinted(make_cylinder(0.28, 3.2, 8, 0.2), {0.17f, 0.12f, 0.08f});
    const glm::dvec4 crowns[] = {{0, 5.3, 0, 2.6}, {1.4, 4.4, 0.5, 1.7}, {-1.2, 4.5, -0.8, 1.8}, {-0.1, 4.2, 1.4, 1.6}};
    float tone = 1;
    for (const glm::dvec4& c : crowns) {
        append(tree, tinted(transformed(make_sphere(c.w, 8, 5), moved(c.x, c.y, c.z) * scaled(1, 0.85, 1)),
                            glm::vec3(0.13f, 0.17f, 0.045f) * tone));
        tone -= 0.08f;
    }
    return tree;
}

/// Makes a house on y = 0 with a ridge along x, eaves and a chimney. Its walls extend 2 m into the ground.
Mesh make_house(const glm::dvec3& size, double roof, const glm::vec3& wall_colour, const glm::vec3& roof_colour) {
    const double x = 0.5 * size.x, z = 0.5 * size.z, y = size.y, low = -2, top = y + roof;
    using P = glm::dvec3;
    Mesh house =
        tinted(make_polygons("walls", {{P(-x, low, z), P(x, low, z), P(x, y, z), P(-x, y, z)},
                                       {P(x, low, -z), P(-x, low, -z), P(-x, y, -z), P(x, y, -z)},
                                       {P(x, low, z), P(x, low, -z), P(x, y, -z), P(x, top, 0), P(x, y, z)},
                                       {P(-x, low, -z), P(-x, low, z), P(-x, y, z), P(-x, top, 0), P(-x, y, -z)},
                                       {P(-x, low, -z), P(x, low, -z), P(x, low, z), P(-x, low, z)}}),
               wall_colour);
    // Two roof slabs, tilted boxes that overlap at the ridge.
    const double eave = 0.45, half = std::hypot(z, roof) * (z + eave) / z, angle = glm::degrees(std::atan2(roof, z));
    for (double side : {1.0, -1.0}) {
        const Mesh slab = make_box({size.x + 2 * eave, 0.22, half});
        append(house, tinted(transformed(slab, moved(0, top + 0.08, 0) * turned(side * angle, {1, 0, 0}) *
                                                   moved(0, 0, side * 0.5 * half)),
                             roof_colour));
    }
    append(house, tinted(transformed(make_box({0.7, 2.2, 0.7}), moved(0.27 * size.x, top - 0.1, 0.28 * z)),
                         {0.24f, 0.13f, 0.10f}));
    return house;
}

void add_village(Scene& scene, int root, int paint) {
    const glm::vec3 walls[] = {{0.62f, 0.56f, 0.44f}, {0.58f, 0.44f, 0.30f}, {0.66f, 0.63f, 0.56f}};
    const glm::vec3 roofs[] = {{0.30f, 0.10f, 0.06f}, {0.24f, 0.09f, 0.06f}, {0.17f, 0.14f, 0.13f}};
    const glm::dvec3 sizes[] = {{11, 4.2, 8}, {9, 5.4, 7.5}, {15, 3.6, 9}};
    int houses[3];
    for (int i = 0; i < 3; ++i)
        houses[i] = add_mesh(scene, fmt::format("House {}", char('A' + i)),
                             make_house(sizes[i], 3.4, walls[i], roofs[i]), paint);

    const int village = add_node(scene, "Village", root);
    Random random(21);
    int count = 0;
    for (int lane = 0; lane < 5; ++lane)
        for (int plot = -4; plot <= 4; ++plot)
            for (double side : {-1.0, 1.0}) {
                const double x = plot * 23 + random.in(-3, 3),
                             z = (lane - 2) * 46 + side * 12.5 + random.in(-1.5, 1.5) + 7 * std::sin(x / 45);
                const double turn = random.in(-7, 7), kind = random.in(0, 3);
                // The green around the church stays free, and houses get sparse towards the village's edge.
                if (std::hypot(x, z - 5) < 34 || std::hypot(x, 1.15 * z) > 82 + random.in(0, 35)) continue;
                add_object(scene, fmt::format("House {}", ++count), village, houses[int(kind)],
                           moved(x, terrain_height(x, z), z) * turned(turn + (side > 0 ? 180 : 0)));
            }
    Mesh church = make_house({22, 8, 10}, 5.5, {0.68f, 0.65f, 0.58f}, {0.15f, 0.13f, 0.13f});
    append(church, tinted(transformed(make_box({6, 22, 6}), moved(-12, 10, 0)), {0.66f, 0.63f, 0.56f}));
    // Four sides, rotated to align with the tower's walls.
    append(church,
           tinted(transformed(make_cylinder(4.9, 12, 4, 0.05), moved(-12, 21, 0) * turned(45)), {0.13f, 0.14f, 0.15f}));
    add_shape(scene, "Church", village, church, paint, moved(4, 0, 5) * turned(-20));
}

void add_trees(Scene& scene, int root, int paint) {
    const int kinds[] = {add_mesh(scene, "Conifer", make_conifer(), paint),
                         add_mesh(scene, "Broadleaf", make_broadleaf(), paint)};
    const int trees = add_node(scene, "Trees", root);
    Random random(33);
    constexpr int kTrees = 1100;
    for (int count = 0, tries = 0; count < kTrees && tries < 100000; ++tries) {
        // Denser towards the centre, where the camera sees them.
        const double r = 950 * std::pow(random.in(0, 1), 0.7), a = random.in(0, 6.283185307179586);
        const double x = r * std::sin(a), z = r * std::cos(a), size = random.in(0.75, 1.35), turn = random.in(0, 360),
                     luck = random.in(-0.9, 0.6);
        const double height = terrain_height(x, z), wood = smooth_noise(x / 130, z / 130, 9);
        if (r < 105 || height < kWaterLevel_m + 1.5 || height > 190 || terrain_slope(x, z) > 0.75 || wood < luck)
            continue;
        const bool conifer = wood + height / 140 > 0.42;
        add_object(scene, fmt::format("Tree {}", ++count), trees, kinds[conifer ? 0 : 1],
                   moved(x, height - 0.3, z) * turned(turn) * scaled(size, size * (conifer ? 1.25 : 1.0), size));
    }
}

}  // namespace

Scene make_landscape_scene() {
    Scene scene = named_scene(
        "landscape",
        "Hills, a lake, 1100 trees and a village on a square of two kilometres: too large for one shadow map.");
    const int paint = add_material(scene, "Painted", glm::vec3(1.0f));
    const int water = add_material(scene, "Lake", {0.07f, 0.14f, 0.17f});
    const int root = add_node(scene, "Landscape");
    add_shape(scene, "Land", root, make_terrain(254), paint);
    add_shape(scene, "Lake", root, make_plane(460, 360), water, moved(330, kWaterLevel_m, -130));
    add_village(scene, root, paint);
    add_trees(scene, root, paint);
    add_camera(scene, {-70, terrain_height(-70, 215) + 26, 215}, {30, 6, -60}, 40);
    return finished(std::move(scene), {{"light.azimuth", "-62"}, {"light.cascades", "4"}, {"light.elevation", "28"}});
}

}  // namespace si
