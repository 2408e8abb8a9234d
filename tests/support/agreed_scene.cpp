#include "tests/support/agreed_scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "renderer/scenes/shapes.h"

namespace si::test {
namespace {

constexpr int kColours = 7, kBoxes = 100, kSpheres = 50, kTori = 10;
constexpr double kSide = 40, kRim = 2;  // m; nothing stands on the ground's rim
constexpr std::array<glm::vec3, kColours + 1> kColour = {{{0.55f, 0.55f, 0.55f},
                                                          {0.8f, 0.25f, 0.2f},
                                                          {0.25f, 0.55f, 0.8f},
                                                          {0.85f, 0.7f, 0.25f},
                                                          {0.3f, 0.65f, 0.35f},
                                                          {0.6f, 0.4f, 0.7f},
                                                          {0.85f, 0.85f, 0.8f},
                                                          {0.9f, 0.5f, 0.2f}}};

/// Subdivision of the shapes.
struct Cut {
    int ground, box, sphere_segments, sphere_rings, torus_segments, torus_sides;
};
constexpr Cut kCuts[] = {{118, 1, 24, 21, 48, 24}, {285, 10, 100, 52, 144, 72}};

/// Numerical Recipes' quick generator: uniform and equal everywhere, unlike the standard library's distributions.
class Dice {
public:
    double between(double lo, double hi) {
        state_ = state_ * 1664525u + 1013904223u;
        return lo + (hi - lo) * double(state_ >> 8) / double(1u << 24);
    }

private:
    std::uint32_t state_ = 7;
};

/// Makes a box one metre a side on y = 0, its faces cut into n by n cells.
Mesh unit_box(int n) {
    const Mesh face = transformed(make_plane(1, 1, n, n), moved(0, 0.5, 0));  // the top of a box about the origin
    Mesh box;
    for (const double angle : {0.0, 90.0, 180.0, 270.0}) append(box, transformed(face, turned(angle, {1, 0, 0})));
    for (const double angle : {90.0, -90.0}) append(box, transformed(face, turned(angle, {0, 0, 1})));
    return transformed(box, moved(0, 0.5, 0));
}

}  // namespace

Scene agreed_scene(AgreedSize size) {
    const Cut& cut = kCuts[int(size)];
    Scene scene;
    scene.name = size == AgreedSize::Triangles100k ? "agreed scene, 100 k triangles" : "agreed scene, 1 M triangles";
    std::array<int, kColours + 1> material{};
    for (std::size_t i = 0; i < material.size(); ++i)
        material[i] = add_material(scene, "m" + std::to_string(i), kColour[i]);
    add_object(scene, "ground", -1,
               add_mesh(scene, "ground", make_plane(kSide, kSide, cut.ground, cut.ground), material[0]));
    Dice dice;
    const double reach = 0.5 * kSide - kRim;
    /// Places `count` copies of a shape in all colours, at the places that place(x, z) returns.
    const auto scatter = [&](const char* name, const Mesh& shape, int count, auto&& place) {
        std::array<int, kColours> mesh{};
        for (int c = 0; c < kColours; ++c)
            mesh[std::size_t(c)] = add_mesh(scene, name + std::to_string(c), shape, material[std::size_t(c + 1)]);
        for (int i = 0; i < count; ++i) {
            const double x = dice.between(-reach, reach), z = dice.between(-reach, reach);
            add_object(scene, name + std::to_string(i), -1, mesh[std::size_t(i % kColours)], place(x, z));
        }
    };
    scatter("box", unit_box(cut.box), kBoxes, [&](double x, double z) {
        const double turn = dice.between(0, 180), wide = dice.between(0.4, 1.6), high = dice.between(0.5, 4),
                     deep = dice.between(0.4, 1.6);
        return moved(x, 0, z) * turned(turn) * scaled(wide, high, deep);
    });
    scatter("sphere", make_sphere(1, cut.sphere_segments, cut.sphere_rings), kSpheres, [&](double x, double z) {
        const double radius = dice.between(0.35, 1), lift = dice.between(-2, 2);
        return moved(x, radius + std::max(lift, 0.0), z) * scaled(radius, radius, radius);
    });
    scatter("torus", make_torus(1, 0.35, cut.torus_segments, cut.torus_sides), kTori, [&](double x, double z) {
        const double large = dice.between(1, 1.5), a = dice.between(0, 360), b = dice.between(0, 360);
        return moved(x, 1.35 * large, z) * turned(a) * turned(b, {1, 0, 0}) * scaled(large, large, large);
    });
    add_camera(scene, {19, 13, 21}, {0, 0.5, 0}, 45);
    finalise(scene);
    return scene;
}

}  // namespace si::test
