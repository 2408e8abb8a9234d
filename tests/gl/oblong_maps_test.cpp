// Compares maps that are not square with the square map that they are a strip of.
#include <algorithm>
#include <cmath>

#include "renderer/bundle/imported_maps.h"
#include "renderer/inspect/probe.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/settings/filters.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Map of 256² texels, and the strip of 64×256 texels in its middle, with the view of each.
struct MapAndStrip {
    std::shared_ptr<const ImportedMaps> square, strip;
};

class OblongMapsTest : public FrameTest {
protected:
    static constexpr int kSide = 256, kWidth = 64;
    FrameRequest request{.width = 160, .height = 120, .outputs = {.visibility = true}};

    /// Draws a light's square map and cuts the strip out of it.
    MapAndStrip draw_and_cut(const Scene& scene, const Settings& s) {
        FrameRequest maps = request;
        maps.outputs.shadow_map = true;
        maps.map_size = MapSize(kSide);
        const FrameResult frame = renderer.render(scene, s, maps);
        const FloatImage whole = renderer.read_shadow_map(frame, 0, 0);
        FloatImage middle{kWidth, kSide, 1, {}};
        for (int y = 0; y < kSide; ++y) {
            const auto row = whole.data.begin() + std::ptrdiff_t(y) * kSide + (kSide - kWidth) / 2;
            middle.data.insert(middle.data.end(), row, row + kWidth);
        }
        const LightView view = frame.lights.at(0).views.at(0);
        glm::dmat4 clip = view.clip_from_relative(glm::dvec3(0));
        for (int column = 0; column < 4; ++column) clip[column].x *= double(kSide) / kWidth;
        const LightView narrow = view_of_matrix(clip, view.curve.convention);
        return {imported_maps({whole}, ImportedViews{{view}, {}}),
                imported_maps({middle}, ImportedViews{{narrow}, {}})};
    }

    FloatImage visibility_of(const Scene& scene, const Settings& s, std::shared_ptr<const ImportedMaps> maps) {
        FrameRequest r = request;
        r.imported = {std::move(maps)};
        return renderer.read_float(renderer.render(scene, s, r).visibility, 1);
    }
};

SI_TEST_IS(Slow, OblongMapsTest, AStripShadesAsItsSquareMap);
TEST_F(OblongMapsTest, AStripShadesAsItsSquareMap) {
    const Scene scene = test::floor_and_box(4, {1.5, 1, 2}, 0.4);
    for (const LightType type : {LightType::Directional, LightType::Spot})
        for (const std::string_view kernel : sweep_kernels()) {
            SCOPED_TRACE(testing::Message() << kernel << " light " << int(type));
            Settings s = test::texel_settings(kernel, kSide, 1);
            s.lights[0].type = type;
            s.lights[0].fit = LightFit::Manual;
            s.lights[0].extent = 16;
            s.lights[0].cone = 120;
            if (type != LightType::Directional) s.lights[0].distance = 9;
            const MapAndStrip maps = draw_and_cut(scene, s);
            const FloatImage square = visibility_of(scene, s, maps.square);
            EXPECT_GT(std::ranges::count_if(square.data, [](float v) { return v < 0.5f; }), 200);
            EXPECT_EQ(differing_values(square, visibility_of(scene, s, maps.strip), 0.02f), 0u);
        }
}

// A directional light's penumbra is as wide as its disc seen from the occluder's distance, whatever a texel's shape.
TEST_F(OblongMapsTest, AProbesPenumbraHasTheWidthOfTheLight) {
    const Scene scene = test::floor_and_box(4, {1.5, 1, 2}, 0.4);
    Settings s = test::texel_settings("pcss", 600, 1);
    s.lights[0].fit = LightFit::Manual;
    s.lights[0].extent = 16;
    s.lights[0].size = 4;
    request.map_size = MapSize(600, 150);
    int compared = 0;
    for (int y = 10; y < request.height; y += 6)
        for (int x = 10; x < request.width; x += 6) {
            const Probe probe = renderer.probe(scene, s, request, x, y);
            if (!probe.hit) continue;
            const Probe::PerLight& light = probe.lights.at(0);
            const double texels = light.kernel.penumbra_texels;
            // A penumbra has at least one texel, and filter.max_radius limits it.
            if (std::isnan(texels) || texels < 1.01 || texels > 1.99 * s.filter.max_radius) continue;
            ++compared;
            EXPECT_GT(light.account.receiver.texel_m, 1.5 * light.account.receiver.texel_short_m);
            const double wide_m = 2 * light.fitted.size * light.kernel.blocker_m;
            EXPECT_NEAR(light.penumbra_m() / wide_m, 1, 1e-3) << x << ", " << y;
        }
    EXPECT_GT(compared, 3);
}

}  // namespace
}  // namespace si
