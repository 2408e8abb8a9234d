// Tests how light and shadow become a picture: in one pass with visibility as a factor, or in a dim and a lit pass.
#include <algorithm>
#include <cmath>

#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"

namespace si {
namespace {

class CompositionTest : public FrameTest {};

// Each pixel of a soft shadow is lit or dim, depending on whether its visibility reaches the alpha test. A dim pixel
// has the requested share of diffuse light.
TEST_F(CompositionTest, PixelsAreLitFrom99PercentAndDimBelow) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const LightType type : test::kLightTypes) {
        Settings s = test::texel_settings("pcf9", 128, 6);
        s.lights[0].type = type;
        if (type != LightType::Directional) set_all(s, {"light.distance=9", "light.cone=90"});
        s.shading = {.ambient = 0.1, .diffuse = 0.7, .specular = 0};
        s.shading.composition = Composition::DimLit;
        s.shading.dim = 0.3;
        FrameRequest request = small_request({.visibility = true});
        const FrameResult frame = renderer.render(scene, s, request);
        const FloatImage v = renderer.read_float(frame.visibility, 1);
        const ByteImage drawn = renderer.read_colour(frame.colour);
        s.lights[0].cast = false;
        s.shading.composition = Composition::Ambient;
        const ByteImage all_lit = picture(scene, s);
        s.shading.diffuse *= 0.3;
        const ByteImage all_dim = picture(scene, s);
        int lit = 0, dim = 0, soft = 0;
        for (std::size_t i = 0; i < v.data.size(); ++i) {
            const bool passes = v.data[i] >= 0.99f;
            soft += v.data[i] > 0.01f && !passes;
            passes ? ++lit : ++dim;
            for (std::size_t c = 0; c < 3; ++c)
                ASSERT_NEAR(drawn.data[4 * i + c], (passes ? all_lit : all_dim).data[4 * i + c], 1)
                    << i << " " << v.data[i];
        }
        EXPECT_GT(lit, 1000);
        EXPECT_GT(dim, 500);
        EXPECT_GT(soft, 100);
    }
}

TEST_F(CompositionTest, FusedAndSeparateVisibilityGiveTheSamePicture) {
    const Scene scene = load_scene("stage");
    Settings s = settings_for(scene, {"shading.composition=dim-lit"});
    const ByteImage fused = picture(scene, s);
    s.shading.separate_visibility = true;
    EXPECT_EQ(different_pixels(fused, picture(scene, s)), 0u);
    s.shading.composition = Composition::Ambient;
    EXPECT_GT(different_pixels(fused, picture(scene, s)), 1000u);
}

// Both ways to a map coordinate are equal in exact numbers. In single precision their difference grows with the
// distance from the camera to the surface.
TEST_F(CompositionTest, TextureMatrixFromEyeSpaceDiffersByRoundingOnly) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const LightType type : test::kLightTypes) {
        Settings s = test::texel_settings("pcf3", 1024, 3);
        s.lights[0].type = type;
        if (type != LightType::Directional) set_all(s, {"light.distance=9", "light.cone=90"});
        const auto worst = [&](double distance_m) {
            s.camera.distance = distance_m;
            s.camera.fov = 2 * std::atan(4 / distance_m) * 180 / 3.14159265;
            const FloatImage image = overlay_values(scene, s, "transform-difference");
            double most = 0;
            for (std::size_t i = 0; i < image.data.size(); i += 4)
                if (std::isfinite(image.data[i])) most = std::max(most, double(image.data[i]));
            return most;
        };
        const double near = worst(10), far = worst(1e5);
        EXPECT_GT(near, 0) << "they are computed apart";
        EXPECT_LT(near, 0.02);
        EXPECT_GT(far, 20 * near);
        EXPECT_LT(far, 1024 * 4e5 / 10 * 0x1p-22) << "1e5 m in single precision, as texels of a map 10 m wide";
        set_all(s, {"camera.distance=10", "camera.fov=45"});
        const ByteImage world = picture(scene, s);
        s.map.transform = MapTransform::Eye;
        EXPECT_LT(different_pixels(world, picture(scene, s)), 200u) << "pixels whose comparison lies on the edge";
    }
}

}  // namespace
}  // namespace si
