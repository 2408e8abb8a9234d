// Objects and figures that resemble characters, close together: contact shadows and self-shadowing on round limbs.
#include "renderer/scenes/figure.h"
#include "renderer/scenes/makers.h"
#include "renderer/scenes/shapes.h"

namespace si {

Scene make_figures_scene() {
    Scene scene;
    scene.name = "figures";
    scene.about = "Three jointed figures, walking, reaching and kneeling, among simple objects.";
    const int floor = add_material(scene, "Parquet", {0.40f, 0.30f, 0.21f});
    const int wall = add_material(scene, "Wash", {0.52f, 0.52f, 0.47f});
    const int joints = add_material(scene, "Joints", {0.16f, 0.12f, 0.10f});
    const int beech = add_material(scene, "Beech", {0.66f, 0.48f, 0.28f});
    const int teal = add_material(scene, "Teal", {0.10f, 0.30f, 0.31f});
    const int rose = add_material(scene, "Rose", {0.52f, 0.22f, 0.20f});
    const int ivory = add_material(scene, "Ivory", {0.72f, 0.67f, 0.56f});

    const int root = add_node(scene, "Room");
    add_object(scene, "Floor", root, add_mesh(scene, "Floor", make_plane(9, 7), floor));
    add_object(scene, "Back wall", root, add_mesh(scene, "Back wall", make_box({9, 3.2, 0.2}), wall),
               moved(0, 1.6, -3.4));

    Pose walking;
    walking.lean = 4;
    walking.twist = -6;
    walking.head_turn = 12;
    walking.hip[0] = -16;
    walking.knee[0] = 26;
    walking.hip[1] = 26;
    walking.knee[1] = 8;
    walking.shoulder[0] = 32;
    walking.elbow[0] = 42;
    walking.shoulder[1] = -28;
    walking.elbow[1] = 20;
    Pose reaching;
    reaching.lean = -5;
    reaching.head_turn = -10;
    reaching.head_nod = -16;
    reaching.shoulder[1] = 148;
    reaching.elbow[1] = 14;
    reaching.arm_out[1] = 16;
    reaching.arm_out[0] = 24;
    reaching.elbow[0] = 30;
    reaching.hip[0] = 8;
    reaching.knee[0] = 12;
    reaching.hip[1] = -4;
    reaching.knee[1] = 4;
    Pose kneeling;
    kneeling.lean = 14;
    kneeling.head_nod = 18;
    kneeling.twist = 10;
    kneeling.hip[0] = 88;
    kneeling.knee[0] = 92;
    kneeling.hip[1] = 2;
    kneeling.knee[1] = 84;
    kneeling.leg_out[0] = 10;
    kneeling.shoulder[0] = 46;
    kneeling.elbow[0] = 38;
    kneeling.shoulder[1] = 26;
    kneeling.elbow[1] = 60;
    const FigureMeshes wooden = add_figure_meshes(scene, beech, joints), dark = add_figure_meshes(scene, teal, joints),
                       red = add_figure_meshes(scene, rose, joints);
    add_figure(scene, wooden, "Walking figure", root, moved(-1.55, 0, 0.25) * turned(52), walking);
    add_figure(scene, dark, "Reaching figure", root, moved(0.35, 0, -0.75) * turned(-24), reaching);
    add_figure(scene, red, "Kneeling figure", root, moved(1.55, 0, 0.75) * turned(-58), kneeling);

    add_object(scene, "Column", root, add_mesh(scene, "Column", make_cylinder(0.24, 1.9, 48, 0.20), ivory),
               moved(2.5, 0, -1.7));
    add_object(scene, "Ball", root, add_mesh(scene, "Ball", make_sphere(0.28), teal), moved(0.35, 0.28, 1.35));
    add_object(scene, "Crate", root, add_mesh(scene, "Crate", make_box({0.75, 0.75, 0.75}), beech),
               moved(-2.75, 0.375, -1.35) * turned(22));
    add_object(scene, "Ring", root, add_mesh(scene, "Ring", make_torus(0.34, 0.09), rose), moved(-0.65, 0.09, 1.45));
    add_object(scene, "Pill", root, add_mesh(scene, "Pill", make_capsule(0.14, 0.5), ivory),
               moved(-2.75, 0.75 + 0.14, -1.35) * turned(-30) * turned(90, {0, 0, 1}) * moved(0, -0.25, 0));
    add_camera(scene, {1.0, 2.05, 5.6}, {0.0, 0.86, -0.3}, 36);
    scene.suggested = {{"light.azimuth", "-48"}, {"light.elevation", "40"}};
    finalise(scene);
    return scene;
}

}  // namespace si
