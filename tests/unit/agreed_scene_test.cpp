// Tests of the benchmarks' agreed scene.
#include "tests/support/agreed_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/sweep/spec.h"

namespace si::test {
namespace {

TEST(AgreedScene, HasItsTrianglesPlainColoursAndNoTextures) {
    for (const auto& [size, triangles] :
         {std::pair{AgreedSize::Triangles100k, 100'088u}, {AgreedSize::Triangles1M, 999'810u}}) {
        const Scene scene = agreed_scene(size);
        EXPECT_EQ(scene.triangle_count(), triangles);
        EXPECT_EQ(scene.objects.size(), 161u);
        EXPECT_EQ(scene.meshes.size(), 22u);
        EXPECT_TRUE(scene.textures.empty());
        EXPECT_EQ(scene.materials.size(), 8u);
        EXPECT_TRUE(std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
            return m.alpha == AlphaMode::Opaque && m.base_colour_texture < 0 && m.normal_texture < 0;
        }));
        EXPECT_EQ(scene.cameras.size(), 1u);
        EXPECT_NEAR(scene.bounds.lo.y, 0, 0.2);
        EXPECT_NEAR(scene.bounds.lo.x, -20, 0.5);
        EXPECT_EQ(scene_content_key(agreed_scene(size)), scene_content_key(scene)) << "the same each time";
    }
}

}  // namespace
}  // namespace si::test
