// Draws maps that are not square, and compares their shadows with those of square maps.
#include <cmath>

#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class MapSizes : public FrameTest {
protected:
    static double mean_difference(const FloatImage& a, const FloatImage& b) {
        EXPECT_EQ(a.data.size(), b.data.size());
        double sum = 0;
        for (std::size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i) sum += std::abs(a.data[i] - b.data[i]);
        return sum / double(a.data.size());
    }
    FloatImage drawn(const Scene& scene, const Settings& s, MapSize size, FrameResult* frame = nullptr) {
        return visibility(scene, s, {.width = 96, .height = 72, .map_size = size}, frame);
    }
};

SI_TEST_IS(Slow, MapSizes, EveryLightDrawsTheShadowsOfASquareMap);
// Each side of a map that is not square is at least as fine as that of the square map of its shorter side. So its
// shadows are at least as close to those of a fine map.
TEST_F(MapSizes, EveryLightDrawsTheShadowsOfASquareMap) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const auto& [type, fit] : {std::pair{LightType::Directional, LightFit::Casters},
                                    {LightType::Directional, LightFit::Lispsm},
                                    {LightType::Directional, LightFit::Stabilised},
                                    {LightType::Spot, LightFit::Scene},
                                    {LightType::Point, LightFit::Scene}})
        for (const char* kernel : {"hard", "pcss", "vsm", "msm_hamburger"}) {
            Settings s = test::texel_settings(kernel, 512, 0.7);
            s.lights[0].type = type;
            s.lights[0].fit = fit;
            s.lights[0].cone = 80;
            if (type != LightType::Directional) s.lights[0].distance = 9;
            const FloatImage fine = drawn(scene, s, 512);
            const double coarse = mean_difference(drawn(scene, s, 64), fine);
            SCOPED_TRACE(testing::Message() << int(type) << " " << int(fit) << " " << kernel);
            EXPECT_LE(mean_difference(drawn(scene, s, {64, 300}), fine), 1.1 * coarse + 2e-3);
        }
}

TEST_F(MapSizes, ReadBackHasBothSides) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    FrameRequest request{.width = 96, .height = 72, .outputs = {.shadow_map = true}, .map_size = MapSize(80, 48)};
    const FrameResult frame = renderer.render(scene, test::texel_settings("hard", 512, 0.7), request);
    const FloatImage map = renderer.read_shadow_map(frame, 0, 0);
    EXPECT_EQ(map.width, 80);
    EXPECT_EQ(map.height, 48);
    EXPECT_EQ(frame.map_view_size, glm::ivec2(80, 48));
    EXPECT_GT(values_between(map, 0, 0.999f), 100u);
}

// Virtual maps consist of square levels.
TEST_F(MapSizes, VirtualMapsStaySquare) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings("hard", 512, 0.7);
    set_setting(s, "map.virtual", "true");
    const FrameResult frame = renderer.render(scene, s, {.width = 96, .height = 72, .map_size = MapSize(80, 48)});
    EXPECT_TRUE(frame.map_size.is_square());
}

}  // namespace
}  // namespace si
