#include "renderer/scenes/stage_materials.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/scenes/shapes.h"

namespace si {
namespace {

/// Draws a texture of four by four square slabs with slightly different tones and dark joints.
Texture make_paving() {
    constexpr int kSize = 256, kSlab = kSize / 4;
    Texture texture;
    texture.name = "Paving";
    texture.width = texture.height = kSize;
    std::vector<std::uint8_t> rgba(std::size_t(kSize) * kSize * 4);
    Random random(11);
    double tones[16];
    for (double& tone : tones) tone = random.in(0.955, 1.0);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const int edge =
                std::min(std::min(x % kSlab, kSlab - 1 - x % kSlab), std::min(y % kSlab, kSlab - 1 - y % kSlab));
            const double tone = tones[(y / kSlab) * 4 + x / kSlab] * (edge == 0 ? 0.80 : edge == 1 ? 0.93 : 1.0);
            std::uint8_t* out = &rgba[std::size_t(y * kSize + x) * 4];
            for (int c = 0; c < 3; ++c) out[c] = std::uint8_t(255 * tone + 0.5);
            out[3] = 255;
        }
    texture.rgba = std::move(rgba);
    return texture;
}

}  // namespace

int add_material(Scene& scene, const PlainMaterial& material) {
    return add_material(scene, material.name, material.linear_colour);
}

int add_paving(Scene& scene) {
    scene.textures.push_back(make_paving());
    const int stone = add_material(scene, "Limestone", {0.60f, 0.54f, 0.45f});
    scene.materials[std::size_t(stone)].base_colour_texture = int(scene.textures.size()) - 1;
    return stone;
}

}  // namespace si
