// The default scene: each of its objects provokes one shadow map artefact.
#include <fmt/format.h>

#include <cmath>

#include "renderer/scenes/figure.h"
#include "renderer/scenes/foliage.h"
#include "renderer/scenes/makers.h"
#include "renderer/scenes/shapes.h"
#include "renderer/scenes/stage_materials.h"

namespace si {
namespace {

void add_ground(Scene& scene, int root) {
    const int stone = add_paving(scene);
    const int plinth = add_material(scene, "Plinth", {0.30f, 0.27f, 0.24f});

    constexpr double kRadius = 13;
    Mesh disc = make_revolution("ground", {{0, 0, 0, 1}, {kRadius, 0, 0, 1}}, 96);
    for (std::size_t i = 0; i < disc.uv.size(); ++i)
        disc.uv.edit()[i] = glm::vec2(disc.positions[i].x, disc.positions[i].z) / kPavingSide_m;
    const Mesh edge = make_revolution(
        "edge", {{kRadius, 0, 1, 0}, {kRadius, -0.35, 1, 0}, {kRadius, -0.35, 0, -1}, {0, -0.35, 0, -1}}, 96);
    add_shape(scene, "Ground", root, disc, stone);
    add_shape(scene, "Plinth", root, edge, plinth);
}

void add_fence(Scene& scene, int root) {
    const int wood = add_material(scene, "Weathered wood", {0.36f, 0.30f, 0.25f});
    const int steel = add_material(scene, "Steel wire", {0.42f, 0.43f, 0.44f});
    constexpr double kBay = 1.5, kHeight = 1.05;
    constexpr int kPicketBays = 3, kWireBays = 2, kBays = kPicketBays + kWireBays;
    const int post = add_mesh(scene, "Post", make_box({0.10, kHeight + 0.12, 0.10}), wood);
    const int picket =
        add_mesh(scene, "Picket",
                 make_polygons("picket",
                               [] {
                                   const double x = 0.026, z = 0.009, top = kHeight, neck = kHeight - 0.045, low = 0.06;
                                   using Face = std::vector<glm::dvec3>;
                                   return std::vector<Face>{
                                       {{-x, low, z}, {x, low, z}, {x, neck, z}, {0, top, z}, {-x, neck, z}},
                                       {{x, low, -z}, {-x, low, -z}, {-x, neck, -z}, {0, top, -z}, {x, neck, -z}},
                                       {{x, low, z}, {x, low, -z}, {x, neck, -z}, {x, neck, z}},
                                       {{-x, low, -z}, {-x, low, z}, {-x, neck, z}, {-x, neck, -z}},
                                       {{x, neck, z}, {x, neck, -z}, {0, top, -z}, {0, top, z}},
                                       {{-x, neck, -z}, {-x, neck, z}, {0, top, z}, {0, top, -z}},
                                       {{-x, low, -z}, {x, low, -z}, {x, low, z}, {-x, low, z}}};
                               }()),
                 wood);
    const int rail = add_mesh(scene, "Rail", make_box({kPicketBays * kBay, 0.07, 0.03}), wood);
    const int wire =
        add_mesh(scene, "Wire", transformed(make_cylinder(0.004, kWireBays * kBay, 8), turned(-90, {0, 0, 1})), steel);

    // Along +x of its own node, from the near end to the far one.
    const int fence = add_node(scene, "Fence", root, moved(3.25, 0, 3.9) * turned(74));
    for (int i = 0; i <= kBays; ++i)
        add_object(scene, fmt::format("Post {}", i + 1), fence, post, moved(i * kBay, 0.5 * (kHeight + 0.12), 0));
    for (int i = 0; i < 2; ++i)
        add_object(scene, fmt::format("Rail {}", i + 1), fence, rail,
                   moved((kWireBays + 0.5 * kPicketBays) * kBay, i == 0 ? 0.28 : 0.78, 0));
    constexpr int kPerBay = 12;
    for (int i = 0; i < kPicketBays * kPerBay; ++i) {
        if (i % kPerBay == 0) continue;  // a post stands there
        add_object(scene, fmt::format("Picket {}", i + 1), fence, picket,
                   moved((kWireBays + double(i) / kPerBay) * kBay, 0, 0.024));
    }
    for (int i = 0; i < 4; ++i)
        add_object(scene, fmt::format("Wire {}", i + 1), fence, wire, moved(0, 0.22 + 0.24 * i, 0));
}

void add_tree(Scene& scene, int root) {
    scene.textures.push_back(make_sprig_texture(128));
    const int bark = add_material(scene, "Bark", {0.19f, 0.14f, 0.10f});
    const int leaves = add_material(scene, "Leaves", glm::vec3(1.0f));
    Material& m = scene.materials[leaves];
    m.base_colour_texture = int(scene.textures.size()) - 1;
    m.alpha = AlphaMode::Mask;
    m.double_sided = true;

    const int tree = add_node(scene, "Tree", root, moved(2.1, 0, -2.5));
    const int limb = add_mesh(scene, "Limb", make_cylinder(1, 1, 20, 0.62), bark);
    const int clusters[2] = {add_mesh(scene, "Leaves A", make_leaf_cluster(0.62, 0.36, 62, 3), leaves),
                             add_mesh(scene, "Leaves B", make_leaf_cluster(0.62, 0.36, 62, 5), leaves)};
    const auto add_limb = [&](const std::string& name, const glm::dvec3& from, const glm::dvec3& to, double radius) {
        const glm::dvec3 d = to - from, up(0, 1, 0);
        const glm::dvec3 axis = glm::cross(up, glm::normalize(d));
        const double s = glm::length(axis), angle = glm::degrees(std::atan2(s, glm::dot(up, glm::normalize(d))));
        const glm::dmat4 turn = s > 1e-9 ? turned(angle, axis / s) : glm::dmat4(1);
        add_object(scene, name, tree, limb,
                   moved(from.x, from.y, from.z) * turn * scaled(radius, glm::length(d), radius));
    };
    const glm::dvec3 fork(0.06, 1.55, 0.02);
    add_limb("Trunk", {0, -0.02, 0}, fork, 0.15);  // leans, so its foot extends into the ground
    const glm::dvec3 tips[] = {
        {-0.95, 2.55, 0.25}, {0.95, 2.60, 0.30}, {0.10, 2.70, -0.95}, {0.05, 2.50, 0.95}, {0.05, 3.35, 0.0}};
    for (int i = 0; i < 5; ++i)
        add_limb(fmt::format("Branch {}", i + 1), fork - glm::dvec3(0, 0.08, 0), tips[i], 0.085);
    const glm::dvec3 more[] = {{-0.55, 3.2, -0.35}, {0.6, 3.25, -0.3}, {-0.1, 3.15, 0.55}, {0.0, 2.55, 0.05}};
    int count = 0;
    const auto add_cluster = [&](const glm::dvec3& at, double size) {
        ++count;
        add_object(scene, fmt::format("Leaves {}", count), tree, clusters[count % 2],
                   moved(at.x, at.y, at.z) * turned(67.0 * count) * scaled(size, size, size));
    };
    for (const glm::dvec3& tip : tips) add_cluster(tip, 1.0);
    for (const glm::dvec3& at : more) add_cluster(at, 0.92);
}

void add_things(Scene& scene, int root) {
    const int plaster = add_material(scene, kPlaster);
    scene.materials[plaster].double_sided = true;
    const int slate = add_material(scene, kSlate);
    const int porcelain = add_material(scene, kPorcelain);
    const int heather = add_material(scene, kHeather);
    const int verdigris = add_material(scene, "Verdigris", {0.16f, 0.34f, 0.30f});
    const int brass = add_material(scene, kBrass);

    add_shape(scene, "Wall", root, make_quad(4.2, 2.5), plaster, moved(-2.7, 0, -2.9) * turned(32));
    add_shape(scene, "Ramp", root, make_wedge({2.2, 0.85, 1.35}), slate, moved(1.25, 0, 1.0) * turned(-14));
    add_object(scene, "Distant box", root, add_mesh(scene, "Box", make_box({1.7, 2.6, 1.7}), heather),
               moved(1.15, 1.3, -9.6) * turned(28));
    add_shape(scene, "Sphere", root, make_sphere(0.42, 96, 48), porcelain, moved(0.25, 0.42, 2.75));
    const int drum =
        add_shape(scene, "Pedestal", root, make_cylinder(0.42, 0.62, 48, 0.38), porcelain, moved(-3.35, 0, 0.75));
    add_shape(scene, "Ring", drum, make_torus(0.30, 0.075), brass,
              moved(0, 0.62 + 0.375, 0) * turned(40) * turned(90, {1, 0, 0}));
    const int rod = add_mesh(scene, "Rod", make_cylinder(0.012, 1, 12), verdigris);
    const int rods = add_node(scene, "Rods", root, moved(-2.05, 0, 2.3));
    for (int i = 0; i < 7; ++i)
        add_object(scene, fmt::format("Rod {}", i + 1), rods, rod,
                   moved(0.16 * i - 0.48, 0, 0.09 * ((i * 3) % 7) - 0.27) * scaled(1, 0.75 + 0.13 * ((i * 5) % 7), 1));
}

}  // namespace

Scene make_stage_scene() {
    Scene scene = named_scene(
        "stage",
        "A thin fence and rods (aliasing), a ramp in grazing light (acne), a figure, a pedestal and a single-plane "
        "wall that stand on the ground (peter-panning), leaves with an alpha mask, and a distant box.");
    const int root = add_node(scene, "Stage");
    add_ground(scene, root);
    add_fence(scene, root);
    add_tree(scene, root);
    add_things(scene, root);

    const int wood = add_material(scene, "Lay figure", {0.62f, 0.42f, 0.22f});
    const int joints = add_material(scene, "Lay figure joints", {0.34f, 0.20f, 0.10f});
    const Pose pose{.lean = 3,
                    .twist = 8,
                    .head_turn = -18,
                    .hip = {24, -14},
                    .knee = {10, 22},
                    .shoulder = {-26, 30},
                    .elbow = {18, 38}};
    add_figure(scene, add_figure_meshes(scene, wood, joints), "Figure", root, moved(-0.75, 0, 0.75) * turned(18), pose);

    add_camera(scene, {-2.3, 3.25, 9.1}, {0.12, 0.98, -0.6}, 35);
    // Low light from the right and slightly behind: the figure stands in the light in front of the wall's shadow, and
    // the shadows of leaves and pickets cross the free ground in front of it.
    return finished(
        std::move(scene),
        {{"light.azimuth", "116"}, {"light.elevation", "25"}, {"light.intensity", "2"}, {"shading.ambient", "0.17"}});
}

}  // namespace si
