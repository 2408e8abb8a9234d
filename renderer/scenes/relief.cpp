// Flat surfaces that look uneven: a normal map bends the light, but the shadow map stores the flat triangles.
#include <cmath>

#include "renderer/scenes/makers.h"
#include "renderer/scenes/shapes.h"

namespace si {
namespace {

/// Draws a normal map of round cobbles, four by four per texture; x along growing u, y along falling v (glTF).
Texture make_cobbles() {
    constexpr int kSize = 256, kCell = kSize / 4;
    constexpr double kSteep = 1.5;  // slope at a cobble's rim
    Texture texture;
    texture.name = "Cobbles";
    texture.width = texture.height = kSize;
    texture.srgb = false;
    std::vector<std::uint8_t> rgba(std::size_t(kSize) * kSize * 4);
    // Height falls with the fourth power of the distance from the cobble's centre: flat there, steep at the joint.
    const auto slope = [](int i) {
        const double t = 2 * (i % kCell + 0.5) / kCell - 1;
        return -kSteep * t * t * t;
    };
    for (int v = 0; v < kSize; ++v)
        for (int u = 0; u < kSize; ++u) {
            const glm::dvec3 n = glm::normalize(glm::dvec3(-slope(u), slope(v), 1));
            std::uint8_t* out = &rgba[std::size_t(v * kSize + u) * 4];
            for (int c = 0; c < 3; ++c) out[c] = std::uint8_t(std::lround(255 * (n[c] * 0.5 + 0.5)));
            out[3] = 255;
        }
    texture.rgba = std::move(rgba);
    return texture;
}

}  // namespace

Scene make_relief_scene() {
    Scene scene = named_scene(
        "relief",
        "A floor and a block whose cobbles are a normal map only, under the shadows of a rail and a sphere: what "
        "happens when a bias follows normals that the triangles do not have.");
    scene.textures.push_back(make_cobbles());
    const int cobbles = add_material(scene, "Cobbles", {0.46f, 0.43f, 0.38f});
    scene.materials[std::size_t(cobbles)].normal_texture = 0;
    const int plain = add_material(scene, "Plain", {0.46f, 0.43f, 0.38f});
    const int wood = add_material(scene, "Wood", {0.40f, 0.25f, 0.13f});
    const int glaze = add_material(scene, "Glaze", {0.16f, 0.30f, 0.38f});

    const int root = add_node(scene, "Relief");
    add_shape(scene, "Floor", root, make_plane(8, 8), cobbles);
    add_shape(scene, "Block", root, make_box({1.5, 1.0, 1.0}), cobbles, moved(-1.5, 0.5, -0.9) * turned(20));
    add_shape(scene, "Slab", root, make_box({1.4, 0.12, 1.0}), plain, moved(1.75, 0.06, 1.5) * turned(-12));
    const int post = add_mesh(scene, "Post", make_box({0.12, 1.3, 0.12}), wood);
    for (int i = 0; i < 3; ++i)
        add_object(scene, "Post " + std::to_string(i + 1), root, post, moved(-0.2 + 1.1 * i, 0.65, -0.6 - 0.2 * i));
    add_shape(scene, "Rail", root, make_box({2.5, 0.12, 0.06}), wood, moved(0.9, 1.12, -0.7) * turned(10.3));
    add_shape(scene, "Sphere", root, make_sphere(0.35), glaze, moved(-0.9, 0.35, 1.1));
    add_camera(scene, {-1.2, 3.0, 6.2}, {0.2, 0.25, 0.2}, 34);
    return finished(std::move(scene), {{"light.azimuth", "-125"}, {"light.elevation", "34"}});
}

}  // namespace si
