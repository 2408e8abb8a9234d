// The three small scenes: floor and boxes, floor and teapot, one plane.
#include <fmt/format.h>

#include <cmath>

#include "renderer/scenes/makers.h"
#include "renderer/scenes/shapes.h"
#include "renderer/scenes/teapot.h"

namespace si {

Scene make_boxes_scene() {
    Scene scene =
        named_scene("boxes", "A floor and boxes that stand on it, hover over it and lean against each other.");
    const int floor = add_material(scene, "Sand", {0.55f, 0.48f, 0.38f});
    const int red = add_material(scene, "Brick", {0.50f, 0.14f, 0.08f});
    const int blue = add_material(scene, "Slate", {0.10f, 0.20f, 0.34f});
    const int pale = add_material(scene, "Chalk", {0.72f, 0.69f, 0.62f});
    const int green = add_material(scene, "Moss", {0.22f, 0.30f, 0.10f});

    const int root = add_node(scene, "Boxes");
    add_shape(scene, "Floor", root, make_plane(14, 14), floor);
    const Mesh cube = make_box({1, 1, 1});
    const int red_cube = add_mesh(scene, "Red cube", cube, red), blue_cube = add_mesh(scene, "Blue cube", cube, blue),
              pale_cube = add_mesh(scene, "Pale cube", cube, pale),
              green_cube = add_mesh(scene, "Green cube", cube, green);
    add_object(scene, "Standing", root, red_cube, moved(-1.3, 0.6, -0.4) * turned(24) * scaled(1.2, 1.2, 1.2));
    add_object(scene, "Hovering", root, blue_cube,
               moved(0.5, 1.75, 0.1) * turned(60, glm::normalize(glm::dvec3(1, 0, 1))) * scaled(0.8, 0.8, 0.8));
    add_object(scene, "Tower", root, pale_cube, moved(2.0, 1.2, -1.6) * turned(-12) * scaled(0.7, 2.4, 0.7));
    add_object(scene, "Flat", root, green_cube, moved(1.5, 0.1, 1.6) * turned(35) * scaled(1.6, 0.2, 1.0));
    // Its lower edge rests on the floor and its back on the red box.
    add_object(scene, "Leaning", root, pale_cube,
               moved(-1.02, 0.6177, 0.62) * turned(24) * turned(-22, {1, 0, 0}) * scaled(0.9, 1.3, 0.08));
    add_camera(scene, {3.4, 3.5, 6.6}, {0.15, 0.75, -0.1}, 38);
    return finished(std::move(scene), {{"light.azimuth", "-52"}, {"light.elevation", "42"}});
}

Scene make_teapot_scene() {
    Scene scene = named_scene(
        "teapot",
        "Newell's teapot, 31.5 cm high, from its published Bezier patches. Its surfaces are open at the lid.");
    const int cloth = add_material(scene, "Linen", {0.56f, 0.52f, 0.45f});
    const int glaze = add_material(scene, "Celadon", {0.22f, 0.40f, 0.33f});
    scene.materials[glaze].double_sided = true;

    const int root = add_node(scene, "Table");
    add_shape(scene, "Floor", root, make_plane(2.4, 2.4), cloth);
    // The unit of the published data is read as a decimetre.
    add_shape(scene, "Teapot", root, make_teapot(), glaze, turned(-28) * scaled(0.1, 0.1, 0.1));
    add_camera(scene, {0.30, 0.52, 1.12}, {-0.03, 0.13, 0}, 34);
    return finished(std::move(scene), {{"light.azimuth", "58"}, {"light.elevation", "38"}});
}

Scene make_plane_scene() {
    Scene scene = named_scene(
        "plane",
        "One plane that meets the view at 1 m at its lower edge and at 100 m at its upper edge. Under a perspective "
        "projection depth values are linear across the picture, so 90 % of them are spent on the first 10 m: stripes "
        "are 1 m deep up to 10 m and 10 m deep beyond.");
    const int chalk = add_material(scene, "Chalk", glm::vec3(1.0f));

    // With near 1 and far 100 the edges lie at 0.92 of the half picture: 1/z, and with it depth, is then linear in the
    // picture's height.
    const double fov_y_deg = 45, edge = 0.92 * std::tan(glm::radians(fov_y_deg / 2)), half_width = 80;
    const glm::dvec3 near_point(0, -edge, -1), far_point(0, 100 * edge, -100);
    const glm::dvec3 n = glm::normalize(glm::cross(glm::dvec3(1, 0, 0), far_point - near_point));
    Mesh plane;
    for (int stripe = 0; stripe < 18; ++stripe) {
        const double z0 = stripe < 9 ? 1 + stripe : 10 * (stripe - 8), z1 = stripe < 9 ? z0 + 1 : z0 + 10;
        const glm::vec4 colour = stripe % 2 ? glm::vec4(0.62f, 0.58f, 0.50f, 1) : glm::vec4(0.24f, 0.30f, 0.36f, 1);
        for (double z : {z0, z1})
            for (double side : {-1.0, 1.0}) {
                const glm::dvec3 p = glm::mix(near_point, far_point, (z - 1) / 99);
                plane.positions.emplace_back(side * half_width, p.y, -z);
                plane.normals.emplace_back(n);
                plane.uv.emplace_back(side * half_width, z);
                plane.colours.push_back(colour);
            }
        const auto first = std::uint32_t(4 * stripe);
        plane.indices.append({first, first + 1, first + 3, first, first + 3, first + 2});
    }
    add_shape(scene, "Plane", -1, std::move(plane), chalk);
    add_camera(scene, {0, 0, 0}, {0, 0, -1}, fov_y_deg);
    scene.cameras[0].near = 1;
    scene.cameras[0].far = 100;
    return finished(std::move(scene), {{"light.azimuth", "30"}, {"light.elevation", "40"}});
}

}  // namespace si
