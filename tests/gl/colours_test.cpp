// Tests that shaders draw the colours that legends explain.
#include "shaders/shared/colours.h"

#include <algorithm>
#include <cmath>

#include "tests/gl/frame_fixture.h"

namespace si {
namespace {

class ColoursTest : public FrameTest {
protected:
    static void expect_colour(const ByteImage& image, int x, int y, const glm::vec3& wanted) {
        const std::uint8_t* p = &image.data[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4];
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(p[c], 255 * wanted[c], 1.01) << x << "," << y << " channel " << c;
    }
};

TEST_F(ColoursTest, DepthBandsFollowDepth) {
    const Scene scene = load_scene("boxes");
    const Settings s =
        settings_for(scene, {"view.map=bands", "map.resolution=128", "view.band_low=0.45", "view.band_high=0.6"});
    FrameRequest request = small_request({.colour = false, .shadow_map = true});
    const FrameResult f = renderer.render(scene, s, request);
    const FloatImage depth = renderer.read_map_view_depth(f);
    const ByteImage shown = renderer.read_colour(f.map_view);
    int bands[3] = {};
    for (int y = 0; y < 128; y += 3)
        for (int x = 0; x < 128; x += 3) {
            const float d = depth.at(x, y);
            const int band = d < 0.45f ? 0 : d < 0.6f ? 1 : 2;
            ++bands[band];
            // The first band covers nearly all of a perspective map; brightness separates its depths.
            expect_colour(shown, x, y,
                          band == 0   ? shared::BAND_NEAR * (0.35f + 0.65f * d / 0.45f)
                          : band == 1 ? shared::BAND_MIDDLE
                                      : shared::BAND_FAR);
        }
    for (const int count : bands) EXPECT_GT(count, 20);
}

TEST_F(ColoursTest, OverlayScalesFollowTheirValues) {
    const Scene scene = load_scene("boxes");
    for (const auto& [overlay, low, middle, high] :
         {std::tuple{"own-depth", shared::SEQUENTIAL_LOW, shared::SEQUENTIAL_MIDDLE, shared::SEQUENTIAL_HIGH},
          {"n-dot-l", shared::DIVERGING_LOW, shared::DIVERGING_MIDDLE, shared::DIVERGING_HIGH}}) {
        const Settings s = settings_for(scene, {{"view.overlay", overlay}, "view.overlay_range=fitted"});
        FrameRequest request = small_request({.overlay = true});
        const FrameResult f = renderer.render(scene, s, request);
        const FloatImage values = renderer.read_float(f.overlay, 4);
        const ByteImage shown = renderer.read_colour(f.colour);
        int seen = 0;
        for (int y = 1; y < 180; y += 7)
            for (int x = 1; x < 320; x += 7) {
                if (values.at(x, y, 3) <= 0 || std::isnan(values.at(x, y))) continue;
                const float t =
                    std::clamp((values.at(x, y) - f.overlay_min) / (f.overlay_max - f.overlay_min), 0.0f, 1.0f);
                expect_colour(shown, x, y, t < 0.5f ? glm::mix(low, middle, 2 * t) : glm::mix(middle, high, 2 * t - 1));
                ++seen;
            }
        EXPECT_GT(seen, 200) << overlay;
    }
}

}  // namespace
}  // namespace si
