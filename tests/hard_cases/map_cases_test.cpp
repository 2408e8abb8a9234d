// Tests hard cases 19, 20 and 29: bad settings, extreme resolutions, the map's border.
#include <algorithm>
#include <cmath>

#include "renderer/scenes/shapes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

// Case 19: sliders that hold NaN, infinities or near >= far.
SI_TEST_IS(Later, HardCase19, BadSettingsAreRepairedAndReported);
TEST(HardCase19, BadSettingsAreRepairedAndReported) {
    const Scene scene = floor_and_box();
    int tried = 0;
    for (LightType type : {LightType::Directional, LightType::Spot, LightType::Point}) {
        for (auto [near, far] : {std::pair{5.0, 5.0}, {20.0, 2.0}, {1e30, 1e-30}, {-4.0, -9.0}}) {
            Settings s = hard_settings();
            s.lights[0].type = type;
            s.lights[0].fit = LightFit::Manual;
            s.lights[0].near = near;
            s.lights[0].far = far;
            const Shot shot = draw_shot(scene, s);
            expect_within_limit(19, shot.frame.notes.empty());
            ++tried;
        }
        for (double bad : {double(NAN), double(INFINITY), -double(INFINITY)}) {
            Settings s = hard_settings();
            LightSettings& l = s.lights[0];
            l.type = type;
            l.azimuth = l.elevation = l.distance = l.target_x = l.target_y = l.size = l.cone = bad;
            l.intensity = l.red = l.near = l.far = l.extent = bad;
            s.bias.constant = s.bias.slope = s.bias.normal = s.bias.raster_slope = s.bias.raster_units = bad;
            s.camera.azimuth = s.camera.distance = s.camera.fov = s.camera.near = s.camera.far = bad;
            s.shading.ambient = s.shading.shininess = s.view.map_black = s.view.overlay_opacity = bad;
            const Shot shot = draw_shot(scene, s);
            expect_within_limit(19, shot.frame.notes.empty());
            ++tried;
        }
        Settings s = hard_settings();
        s.lights[0].type = LightType(77);
        s.map.format = MapFormat(-3);
        s.map.wrap = MapWrap(-3);
        s.map.compare = Compare(-3);
        s.bias.unit = BiasUnit(-3);
        s.filter.kernel = s.view.overlay = -3;
        s.map.resolution = -5;
        s.light_count = 99;
        expect_within_limit(19, draw_shot(scene, s).frame.notes.empty());
        ++tried;
    }
    expect_fault(19, tried);
    EXPECT_TRUE(draw_shot(scene, hard_settings()).frame.notes.empty()) << "good settings need no repair";
}

// Case 20: maps of one texel, and maps above the driver's limit.
TEST(HardCase20, ErrorsFallWithResolution) {
    const Scene scene = floor_and_box(10, {2, 1.5, 2}, 0.3);
    double before = 2;
    std::vector<double> shares;
    for (int n : {1, 4, 16, 64, 256, 1024}) {
        Settings s = hard_settings();
        s.map.resolution = n;
        set_setting(s, "filter.kernel", "hard");
        const Shot shot = draw_shot(scene, s);
        EXPECT_EQ(shot.frame.map_resolution, n);
        EXPECT_EQ(shot.maps.at(0).width, n);
        const ReferenceErrors e = compare_with_reference(shot, scene, 0);
        const double wrong = double(e.false_light + e.false_shadow) / e.domain;
        expect_within_limit(20, std::max(0.0, wrong - before));
        before = wrong;
        shares.push_back(wrong);
    }
    expect_fault(20, shares.front());
    EXPECT_LT(shares.back(), 0.01);
}

SI_TEST_IS(Later, HardCase20, KernelsWiderThanTheMapGiveFinitePictures);
TEST(HardCase20, KernelsWiderThanTheMapGiveFinitePictures) {
    const Scene scene = floor_and_box();
    for (int n : {1, 2, 3})
        for (std::size_t row = 0; row < filters().size(); ++row)
            for (LightType type : {LightType::Directional, LightType::Point}) {
                Settings s = hard_settings();
                s.lights[0].type = type;
                s.map.resolution = n;
                s.filter.kernel = int(row);
                draw_shot(scene, s, 32, 24);
            }
}

TEST(HardCase20, ResolutionsAboveTheDriversLimitAreReduced) {
    Settings s = hard_settings();
    s.map.resolution = 1 << 30;
    s.map.format = MapFormat::D16;
    FrameRequest request;
    request.width = 32;
    request.height = 24;
    Renderer& renderer = hard_renderer();
    const FrameResult frame = renderer.render(floor_and_box(), s, request);
    EXPECT_LE(frame.map_resolution, renderer.driver().max_texture_size);
    EXPECT_GE(frame.map_resolution, 4096);
    EXPECT_FALSE(frame.notes.empty());
    EXPECT_TRUE(renderer.take_gl_messages().empty());
}

// Case 29: points outside the map, and at its border.
SI_TEST_IS(Later, HardCase29, PointsOutsideTheMapAreLit);
TEST(HardCase29, PointsOutsideTheMapAreLit) {
    const Scene scene = floor_and_box(10, {6, 1, 0.5}, 0.2);
    for (const char* filter : {"hard", "hw2x2", "pcf5"}) {
        Settings s =
            settings_with(hard_settings(), {"camera.elevation=70", "camera.distance=14", "map.resolution=128"});
        set_setting(s, "filter.kernel", filter);
        // A map of 4 x 4 m in the middle of 10 x 10 m of floor: the bar's shadow crosses its border.
        set_all(s, {"light.fit=manual", "light.extent=2"});
        const auto wrong_outside = [&](const Shot& shot) {
            const RayReference rays(scene);
            int wrong = 0, outside = 0;
            for (const auto& [x, y, hit] : pixel_hits(rays, shot)) {
                if (glm::dot(hit.normal, shot.light().to_light) <= 1e-3) continue;
                const glm::dvec4 p = uvdw(shot.view(), hit.position);
                // Outside the reach of kernel and normal offset.
                const double pad = (reach_of(s).read + 4) / s.map.resolution;
                if (p.x > -pad && p.x < 1 + pad && p.y > -pad && p.y < 1 + pad) continue;
                ++outside;
                wrong += shot.visibility.at(x, y) < 1 - 1e-5f;  // a mean of weights rounds
            }
            EXPECT_GT(outside, 1000);
            return wrong;
        };
        for (MapWrap wrap : {MapWrap::Border, MapWrap::Range}) {
            s.map.wrap = wrap;
            expect_within_limit(29, wrong_outside(draw_shot(scene, s)));
        }
        s.map.wrap = MapWrap::Clamp;
        expect_fault(29, wrong_outside(draw_shot(scene, s)));
        s.map.wrap = MapWrap::Repeat;
        expect_fault(29, wrong_outside(draw_shot(scene, s)));
    }
}

// Inside the map, along the border, the fitted map's margin keeps every kernel correct.
TEST(HardCase29, NoErrorsLieAlongTheBorder) {
    // The bar touches the edge of the scene, and so of the map.
    const Scene scene =
        grey_scene({{"floor", make_plane(10, 10)}, {"bar", make_box({10, 1, 0.5}), moved(0, 0.8, 4.75)}});
    for (const char* filter : {"hard", "pcf3", "pcf9"}) {
        Settings s =
            settings_with(hard_settings(), {"camera.elevation=70", "camera.distance=14", "map.resolution=256"});
        set_setting(s, "filter.kernel", filter);
        s.bias = no_bias();
        s.bias.unit = BiasUnit::Texels;
        s.bias.constant = 2.5 * reach_of(s).bias;
        const double reach = reach_of(s).edge + 1;
        const ReferenceErrors e = compare_with_reference(draw_shot(scene, s), scene, reach);
        EXPECT_GT(e.shadow, 100) << filter;
        EXPECT_EQ(e.false_shadow, 0) << filter;
        EXPECT_EQ(e.false_light, 0) << filter;
    }
}

}  // namespace
}  // namespace si::test
