// Objects and figures that resemble characters, close together: contact shadows and self-shadowing on round limbs.
#include "renderer/scenes/figure.h"
#include "renderer/scenes/makers.h"
#include "renderer/scenes/shapes.h"

namespace si {

Scene make_figures_scene() {
    Scene scene =
        named_scene("figures", "Three jointed figures, walking, reaching and kneeling, among simple objects.");
    const int floor = add_material(scene, "Parquet", {0.40f, 0.30f, 0.21f});
    const int wall = add_material(scene, "Wash", {0.52f, 0.52f, 0.47f});
    const int joints = add_material(scene, "Joints", {0.16f, 0.12f, 0.10f});
    const int beech = add_material(scene, "Beech", {0.66f, 0.48f, 0.28f});
    const int teal = add_material(scene, "Teal", {0.10f, 0.30f, 0.31f});
    const int rose = add_material(scene, "Rose", {0.52f, 0.22f, 0.20f});
    const int ivory = add_material(scene, "Ivory", {0.72f, 0.67f, 0.56f});

    const int root = add_node(scene, "Room");
    add_shape(scene, "Floor", root, make_plane(9, 7), floor);
    add_shape(scene, "Back wall", root, make_box({9, 3.2, 0.2}), wall, moved(0, 1.6, -3.4));

    const Pose walking{.lean = 4,
                       .twist = -6,
                       .head_turn = 12,
                       .hip = {-16, 26},
                       .knee = {26, 8},
                       .shoulder = {32, -28},
                       .elbow = {42, 20}};
    const Pose reaching{.lean = -5,
                        .head_turn = -10,
                        .head_nod = -16,
                        .hip = {8, -4},
                        .knee = {12, 4},
                        .shoulder = {0, 148},
                        .elbow = {30, 14},
                        .arm_out = {24, 16}};
    const Pose kneeling{.lean = 14,
                        .twist = 10,
                        .head_nod = 18,
                        .hip = {88, 2},
                        .knee = {92, 84},
                        .leg_out = {10, 4},
                        .shoulder = {46, 26},
                        .elbow = {38, 60}};
    const FigureMeshes wooden = add_figure_meshes(scene, beech, joints), dark = add_figure_meshes(scene, teal, joints),
                       red = add_figure_meshes(scene, rose, joints);
    add_figure(scene, wooden, "Walking figure", root, moved(-1.55, 0, 0.25) * turned(52), walking);
    add_figure(scene, dark, "Reaching figure", root, moved(0.35, 0, -0.75) * turned(-24), reaching);
    add_figure(scene, red, "Kneeling figure", root, moved(1.55, 0, 0.75) * turned(-58), kneeling);

    add_shape(scene, "Column", root, make_cylinder(0.24, 1.9, 48, 0.20), ivory, moved(2.5, 0, -1.7));
    add_shape(scene, "Ball", root, make_sphere(0.28), teal, moved(0.35, 0.28, 1.35));
    add_shape(scene, "Crate", root, make_box({0.75, 0.75, 0.75}), beech, moved(-2.75, 0.375, -1.35) * turned(22));
    add_shape(scene, "Ring", root, make_torus(0.34, 0.09), rose, moved(-0.65, 0.09, 1.45));
    add_shape(scene, "Pill", root, make_capsule(0.14, 0.5), ivory,
              moved(-2.75, 0.75 + 0.14, -1.35) * turned(-30) * turned(90, {0, 0, 1}) * moved(0, -0.25, 0));
    add_camera(scene, {1.0, 2.05, 5.6}, {0.0, 0.86, -0.3}, 36);
    return finished(std::move(scene), {{"light.azimuth", "-48"}, {"light.elevation", "40"}});
}

}  // namespace si
