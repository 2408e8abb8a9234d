// Compares look-ups of baked light maps with closed forms and rays, for many positions of scene, light and camera.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/reference/light_map_cache.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/render/reference_frames.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class LightMapTest : public FrameTest {
protected:
    ReferenceCache cache;
    Workers workers{.threads = 2};
    FrameRequest request{.width = 320, .height = 180, .outputs = {.colour = false, .visibility = true}};
    FrameResult frame;

    void SetUp() override {
        FrameTest::SetUp();
        light_maps().clear();
    }
    FloatImage visibility(const Scene& scene, const Settings& s) {
        frame = render_with_reference(renderer, scene, s, request, cache, workers);
        for (const std::string& note : frame.notes) ADD_FAILURE() << note;
        EXPECT_EQ(frame.light_maps.size(), 1u);
        EXPECT_TRUE(frame.light_maps.at(0).met);
        return renderer.read_float(frame.visibility, 1);
    }
    double texel_m() const { return 1 / frame.light_maps.at(0).texels_per_metre; }
    /// Calls a function with point, visibility and reference visibility of each counted pixel.
    template <class Visit>
    void each_pixel(const Scene& scene, const Settings& s, const ReferenceOptions& options, Visit visit) {
        const FloatImage v = visibility(scene, s);
        const TracedReference t = cache.trace(reference_task(renderer, scene, s, request, 0, options), workers);
        for (std::size_t i = 0; i < v.data.size(); ++i)
            if (t.reference->state[i] == PixelState::Counted)
                visit(t.receivers->pixels[i], double(v.data[i]), double(t.reference->visibility.data[i]));
    }
    /// Returns the share of counted pixels on the wrong side of one half.
    double wrong_share(const Scene& scene, const Settings& s) {
        std::size_t wrong = 0, all = 0, dark = 0;
        each_pixel(scene, s, {.nearest = false}, [&](const Receiver&, double v, double t) {
            ++all;
            dark += t < 0.5;
            wrong += (v >= 0.5) != (t >= 0.5);
        });
        EXPECT_GT(dark, all / 100);
        return double(wrong) / double(all);
    }
    std::size_t baked() const { return light_maps().counts().baked; }
};

Settings light_mapped(Settings s, int resolution) {
    set_setting(s, "light.source", "light-map");
    s.light_map.resolution = resolution;
    return s;
}

Settings light_mapped(const Scene& scene, const Sets& more = {}) {
    Settings s = settings_for(scene, more);
    set_setting(s, "light.source", "light-map");
    return s;
}

// At the shadow edge of a sheet of 4 m above a floor a look-up deviates by at most half a texel's diagonal.
TEST_F(LightMapTest, EdgesDeviateByAtMostHalfATexelDiagonal) {
    std::vector<test::Place> places(std::begin(test::kPlaces), std::end(test::kPlaces));
    places.push_back({{115, 0, -115}, 90, 45});
    places.push_back({{1e5, 0, -1e5}, 30, 60});
    for (const test::Place& place : places) {
        const Scene scene = test::floor_under_sheet(place);
        for (const LightType type : test::kLightTypes)
            for (const int resolution : {64, 256}) {
                SCOPED_TRACE(testing::Message() << int(type) << " at " << place.at.x << ", " << resolution);
                Settings s = light_mapped(test::hard_settings(), resolution);
                test::place_light(s, type, place);
                double most_m = 0;
                std::size_t dark = 0, lit = 0;
                each_pixel(scene, s, {.nearest = false}, [&](const Receiver& r, double v, double) {
                    if (std::abs(r.position_ws.y - place.at.y) > 1e-3) return;  // pixels of the sheet
                    const FittedLight& light = frame.lights[0];
                    const glm::dvec3 ray =
                        type == LightType::Directional ? light.to_light : light.position - r.position_ws;
                    const glm::dvec3 at = r.position_ws + ray * (2.25 / ray.y) - place.at;
                    // Under a near light the shadow is larger than the sheet.
                    const double grows = type == LightType::Directional ? 1 : ray.y / (ray.y - 2.25);
                    const double within_m = (2 - std::max(std::abs(at.x), std::abs(at.z))) * grows;
                    (v < 0.5 ? dark : lit) += 1;
                    if ((v < 0.5) != (within_m > 0)) most_m = std::max(most_m, std::abs(within_m));
                });
                EXPECT_LE(most_m, std::numbers::sqrt2 / 2 * texel_m() + 1e-4);
                EXPECT_GT(dark, 500u);
                EXPECT_GT(lit, 500u);
                if (type == LightType::Directional)
                    std::printf("%4d: off by %.4f m at most, of texels of %.4f m\n", resolution, most_m, texel_m());
            }
    }
}

SI_TEST_IS(Repeated, LightMapTest, FinerTexelsApproachRaysOnTheStage);
// Twice the texels per side halve the error along edges.
SI_TEST_IS(Later, LightMapTest, FinerTexelsApproachRaysOnTheStage);
TEST_F(LightMapTest, FinerTexelsApproachRaysOnTheStage) {
    const Scene scene = load_scene("stage");
    std::vector<double> shares;
    for (const int resolution : {256, 512, 1024, 2048}) {
        const Settings s = settings_for(scene, {"light.azimuth=72", "light.elevation=36"});
        shares.push_back(wrong_share(scene, light_mapped(s, resolution)));
        std::printf("%4d: %.3f %% wrong, %.1f texels/m\n", resolution, 100 * shares.back(), 1 / texel_m());
    }
    for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_LT(shares[i], shares[i - 1]);
    const double slope = std::log2(shares.back() / shares.front()) / 3;
    std::printf("slope %.2f\n", slope);
    EXPECT_LT(slope, -0.6);
    EXPECT_LT(shares.back(), 0.014);
}

SI_TEST_IS(Repeated, LightMapTest, PenumbraeMatchTheLightsDisc);
// The expected value is the closed form of a disc's share above a straight edge.
TEST_F(LightMapTest, PenumbraeMatchTheLightsDisc) {
    test::Place above;
    above.elevation = 90;
    const Scene scene = test::floor_under_sheet(above);
    Settings s = settings_with(light_mapped(test::hard_settings(), 1024), {"light.elevation=90", "light.size=6"});
    s.light_map.samples = 256;
    request.width = 960;
    request.height = 540;
    const double radius_m = 2.25 * std::tan(s.lights[0].size * std::numbers::pi / 180);
    double worst = 0, squares = 0;
    std::size_t within = 0;
    each_pixel(scene, s, {.nearest = false}, [&](const Receiver& r, double v, double) {
        if (std::abs(r.position_ws.y) > 1e-3 || std::abs(r.position_ws.z) > 1) return;
        const double d = (std::abs(r.position_ws.x) - 2) / radius_m;  // 1: the whole disc is visible
        if (std::abs(d) > 1.5) return;
        const double c = std::clamp(d, -1.0, 1.0);
        const double share = 0.5 + (c * std::sqrt(1 - c * c) + std::asin(c)) / std::numbers::pi;
        worst = std::max(worst, std::abs(v - share));
        squares += (v - share) * (v - share);
        ++within;
    });
    std::printf("penumbra: off by %.4f at most, %.4f root mean square, %zu pixels\n", worst,
                std::sqrt(squares / double(within)), within);
    ASSERT_GT(within, 300u);
    EXPECT_LT(worst, 0.06);
    EXPECT_LT(std::sqrt(squares / double(within)), 0.02);
}

/// Rotation off the axes in degrees, so that rounding alone moves points out of the wall's plane.
constexpr double kRoomsTurned = 33;

/// Makes two rooms of 3 m with or without a wall of 2 cm between them. One room has a roof and walls, the other is
/// open to the sky.
Scene rooms(bool one_floor, bool sheet = false) {
    Scene scene;
    const int root = add_node(scene, "turned", -1, turned(kRoomsTurned));
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    scene.materials[std::size_t(grey)].double_sided = true;
    const auto box = [&](const char* name, const glm::dvec3& size, double x, double y, double z) {
        add_object(scene, name, root, add_mesh(scene, name, make_box(size), grey), moved(x, y, z));
    };
    if (one_floor) {
        add_object(scene, "floor", root, add_mesh(scene, "floor", make_plane(6, 4), grey));
    } else {
        const int half = add_mesh(scene, "half", make_plane(3, 4), grey);
        add_object(scene, "dark floor", root, half, moved(-1.5, 0, 0));
        add_object(scene, "lit floor", root, half, moved(1.5, 0, 0));
    }
    if (sheet)
        add_object(scene, "wall", root, add_mesh(scene, "wall", make_quad(4, 2), grey), turned(90));
    else
        box("wall", {0.02, 2, 4}, 0, 1, 0);
    box("roof", {3.2, 0.05, 4.2}, -1.5, 2.025, 0);
    box("back", {0.05, 2.2, 4.2}, -3.02, 1, 0);
    box("left", {3.2, 2.2, 0.05}, -1.5, 1, -2.02);
    box("right", {3.2, 2.2, 0.05}, -1.5, 1, 2.02);
    finalise(scene);
    return scene;
}

// A wall much thinner than a texel separates two shadows: surfaces that end at the wall keep their side's. A floor
// that continues below the wall is one chart and mixes both sides within a texel.
TEST_F(LightMapTest, DoesNotBleedAcrossAThinWall) {
    for (const auto& [one_floor, sheet] : {std::pair(false, false), {false, true}, {true, false}}) {
        SCOPED_TRACE(testing::Message() << one_floor << sheet);
        const Scene scene = rooms(one_floor, sheet);
        Settings s = light_mapped(test::hard_settings(), 64);
        s.lights[0].azimuth = 90 + kRoomsTurned;
        set_all(s, {"light.elevation=55", "camera.source=manual"});
        const glm::dvec3 target(turned(kRoomsTurned) * glm::dvec4(-0.6, 0.3, 0, 1));
        set_target(s.camera, target);
        s.camera.azimuth = 265 + kRoomsTurned;
        set_all(s, {"camera.elevation=15", "camera.distance=2", "camera.near=0.05", "camera.fov=80"});
        double brightest = 0, reach_m = 0;
        std::size_t pixels = 0;
        each_pixel(scene, s, {.nearest = false}, [&](const Receiver& r, double v, double t) {
            const double x = (glm::inverse(turned(kRoomsTurned)) * glm::dvec4(r.position_ws, 1)).x;
            if (x > -0.005 || t > 0) return;
            ++pixels;
            brightest = std::max(brightest, v);
            if (v > 0) reach_m = std::max(reach_m, -x);
        });
        EXPECT_GT(pixels, 5000u);
        EXPECT_GT(texel_m(), 0.1) << "far wider than the wall";
        if (one_floor) {
            EXPECT_LE(reach_m, texel_m());
            EXPECT_GT(reach_m, 0) << "if this no longer leaks, say so in the docs";
        } else {
            EXPECT_EQ(brightest, 0);
        }
        std::printf("one floor %d, a sheet %d: brightest %.3f up to %.3f m from the wall, texels of %.3f m\n",
                    one_floor, sheet, brightest, reach_m, texel_m());
    }
}

// Standing, mirrored and turned objects are all in the map; both sides of a sheet have texels of their own.
TEST_F(LightMapTest, ContainsMirroredTurnedAndDoubleSidedObjects) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    scene.materials[std::size_t(grey)].double_sided = true;
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(12, 12), grey));
    const int wedge = add_mesh(scene, "wedge", make_wedge({1.5, 1.5, 1}), grey);
    const int knot = add_mesh(scene, "ring", make_torus(0.7, 0.25, 32, 12), grey);
    add_object(scene, "as it is", -1, wedge, moved(-2, 0, 1));
    add_object(scene, "mirrored", -1, wedge, moved(2, 0, 1) * scaled(-1, 1, 1));
    add_object(scene, "turned", -1, wedge, moved(0, 0, -2) * turned(50) * scaled(1, 1.5, -1));
    add_object(scene, "ring", -1, knot, moved(0, 1.2, 1) * turned(90, {1, 0, 0}) * scaled(1, -1, 1));
    add_object(scene, "sheet", -1, add_mesh(scene, "sheet", make_quad(2, 2), grey), moved(3, 0, -2) * turned(30));
    finalise(scene);
    for (const double azimuth : {-40.0, 60.0, 150.0, 240.0}) {
        Settings s = light_mapped(test::hard_settings(), 1024);
        s.lights[0].azimuth = azimuth;
        s.camera.distance = 10;
        const double wrong = wrong_share(scene, s);
        EXPECT_LT(wrong, 0.012) << azimuth;
        std::printf("azimuth %4.0f: %.3f %% wrong\n", azimuth, 100 * wrong);
    }
}

TEST_F(LightMapTest, LightsAndInstancesHaveSeparateMaps) {
    const Scene scene = load_scene("boxes");
    Settings s = light_mapped(scene, {"light.count=3", "light.1.source=volumes-zfail", "light.2.type=point",
                                      "light.2.azimuth=100", "light.2.source=light-map"});
    for (const int light : {0, 2}) {
        s.view.light = light;
        frame = render_with_reference(renderer, scene, s, request, cache, workers);
        ASSERT_EQ(frame.light_maps.size(), 3u);
        EXPECT_TRUE(frame.light_maps[0].met && frame.light_maps[2].met);
        EXPECT_EQ(frame.light_maps[1].key, 0u);
        const FloatImage v = renderer.read_float(frame.visibility, 1);
        const TracedReference t =
            cache.trace(reference_task(renderer, scene, s, request, light, {.nearest = false}), workers);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < v.data.size(); ++i)
            wrong += t.reference->state[i] == PixelState::Counted &&
                     (v.data[i] < 0.5f) != (t.reference->visibility.data[i] < 0.5f);
        EXPECT_LT(double(wrong), 0.01 * double(v.data.size())) << light;
    }
}

// Cameras share a map; each change that rays can see needs another.
TEST_F(LightMapTest, IsBakedOnceForAllCamerasAndAgainForOtherChanges) {
    const Scene scene = load_scene("figures");
    Settings s = light_mapped(scene, {"light_map.resolution=256"});
    const std::size_t before = baked();
    visibility(scene, s);
    EXPECT_EQ(baked(), before + 1);
    EXPECT_EQ(frame.pass("light map")->state, PassState::Drawn);
    EXPECT_NE(frame.pass("light map")->reason.find("256² texels of a byte"), std::string::npos)
        << frame.pass("light map")->reason;
    EXPECT_EQ(frame.light_maps[0].bytes, 256u * 256u);
    const auto expect_known = [&](const char* key, const char* value) {
        Settings other = s;
        set_setting(other, key, value);
        const FrameResult f = renderer.render(scene, other, request);
        EXPECT_TRUE(f.light_maps[0].met) << key;
        EXPECT_EQ(f.pass("light map")->state, PassState::Cached) << key;
    };
    expect_known("camera.azimuth", "77");
    expect_known("camera.fov", "20");
    expect_known("filter.kernel", "hard");
    expect_known("map.resolution", "64");
    expect_known("light.intensity", "2");
    expect_known("light.size", "3");
    EXPECT_EQ(baked(), before + 1);
    const auto expect_unknown = [&](const char* key, const char* value) {
        Settings other = s;
        set_setting(other, key, value);
        FrameRequest untraced = request;
        const FrameResult f = renderer.render(scene, other, untraced);
        EXPECT_FALSE(f.light_maps[0].met) << key;
        ASSERT_FALSE(f.notes.empty()) << key;
        EXPECT_NE(f.notes.back().find("light 0 has no shadow yet"), std::string::npos) << f.notes.back();
        EXPECT_NE(f.pass("visibility")->reason.find("not baked yet"), std::string::npos) << key;
        const FloatImage lit = renderer.read_float(f.visibility, 1);
        EXPECT_EQ(std::count(lit.data.begin(), lit.data.end(), 1.f), std::ptrdiff_t(lit.data.size())) << key;
    };
    expect_unknown("light.azimuth", "77");
    expect_unknown("light.type", "point");
    expect_unknown("light_map.resolution", "300");
    expect_unknown("caster.blend", "mask");
    Settings area = s;
    area.light_map.samples = 64;
    area.lights[0].size = 2;
    EXPECT_FALSE(renderer.render(scene, area, request).light_maps[0].met);
    Settings dropped = s;
    dropped.objects[scene.nodes[std::size_t(scene.objects[0].node)].path].cast = false;
    EXPECT_FALSE(renderer.render(scene, dropped, request).light_maps[0].met);
    // Another pose and back: the map is keyed by its inputs.
    Scene moved = scene;
    moved.nodes[std::size_t(moved.objects[0].node)].local[3].x += 0.3;
    refresh(moved);
    EXPECT_FALSE(renderer.render(moved, s, request).light_maps[0].met);
    const FloatImage here = visibility(scene, s), there = visibility(moved, s);
    EXPECT_NE(here.data, there.data);
    EXPECT_EQ(baked(), before + 2);
    refresh(moved);
    EXPECT_EQ(visibility(moved, s).data, there.data);
    EXPECT_EQ(baked(), before + 2) << "under another number it is the same scene";
}

TEST_F(LightMapTest, HasTheSameBytesAfterEviction) {
    const Scene scene = load_scene("boxes");
    const Settings s = light_mapped(scene, {"light.size=2", "light_map.samples=64", "light_map.resolution=200"});
    const FloatImage first = visibility(scene, s);
    light_maps().clear();
    request.light_maps.clear();
    Renderer fresh;
    const FloatImage again =
        fresh.read_float(render_with_reference(fresh, scene, s, request, cache, workers).visibility, 1);
    EXPECT_EQ(first.data, again.data);
}

}  // namespace
}  // namespace si
