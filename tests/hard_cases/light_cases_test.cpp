// Tests hard cases 6 to 9: lights in awkward places.
#include <algorithm>
#include <cmath>

#include "renderer/measure/measured_error.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"

namespace si::test {
namespace {

// Case 6: with the light parallel to "up", a basis from a cross product is 0/0 at exactly 0 degrees.
TEST(HardCase6, ALightStraightAboveCastsCorrectShadows) {
    // A thin plate: its sides, where N.L changes sign under any tilt, fill no pixel.
    const Scene scene = floor_and_box(10, {3, 1e-3, 3}, 1.0);
    for (LightType type : {LightType::Directional, LightType::Spot}) {
        Settings s = hard_settings();
        s.camera.elevation = 30;
        s.lights[0].type = type;
        s.lights[0].elevation = 90;
        const Shot exact = draw_shot(scene, s);
        expect_fault(6, shadow_share(exact));
        s.lights[0].elevation = 90 - 1e-4 * 180 / M_PI;
        // 1e-4 rad move the shadow by 0.1 mm: only edge pixels may change.
        expect_within_limit(6, differing_share(exact, draw_shot(scene, s), 0.5));
        s.lights[0].elevation = -90;
        draw_shot(scene, s);
    }
}

// Faces exactly parallel to the light face away from it: in the picture, in the reference, in the probe.
TEST(HardCase6, FacesParallelToTheLightAreDark) {
    Scene scene;
    add_object(scene, "floor", -1, add_mesh(scene, "floor", make_plane(10, 10), -1));
    const int box = add_mesh(scene, "box", make_box({1.5, 1, 2}), -1);
    add_object(scene, "box", -1, box, moved(0, 0.5, 0));
    add_object(scene, "turned", -1, box, moved(2.5, 0.5, -1) * turned(37));
    finalise(scene);
    for (const glm::dvec2& angles :
         {glm::dvec2(0, 90), {90, 90}, {-90, 90}, {180, 90}, {17, 90}, {90, 0}, {180, 40}, {-90, 25}})
        for (const LightType type : {LightType::Directional, LightType::Spot}) {
            SCOPED_TRACE(testing::Message()
                         << "azimuth " << angles.x << " elevation " << angles.y << " type " << int(type));
            Settings s = hard_settings();
            s.lights[0].type = type;
            s.lights[0].azimuth = angles.x;
            s.lights[0].elevation = angles.y;
            const Shot shot = draw_shot(scene, s);
            const RayReference rays(scene);
            int parallel = 0, lit = 0;
            for (const auto& [x, y, hit] : pixel_hits(rays, shot)) {
                if (std::abs(glm::dot(hit.normal, direction_to(shot.light(), hit.position))) > 1e-12) continue;
                ++parallel;
                lit += shot.visibility.at(x, y) > 0;
            }
            if (type == LightType::Directional) {
                EXPECT_GT(parallel, 50);
            }
            EXPECT_LE(lit, parallel / 20) << "only where the ray and the rasteriser choose another face";
        }
    // The reference counts none of these pixels, so none is false.
    for (const double azimuth : {0.0, 90.0, -90.0, 180.0}) {
        Settings s = hard_settings();
        s.lights[0].azimuth = azimuth;
        s.lights[0].elevation = 90;
        ReferenceCache cache;
        const MeasuredError m = measure_error(hard_renderer(), scene, s, {.width = 160, .height = 120}, 0, {}, cache);
        const Shot shot = draw_shot(scene, s);
        EXPECT_GT(m.traced.reference->pixels[std::size_t(PixelState::FacesAway)], 300u);
        EXPECT_EQ(m.metrics.any_acne, 0) << azimuth;
        for (std::size_t i = 0; i < m.traced.reference->state.size(); ++i)
            if (m.traced.reference->state[i] == PixelState::FacesAway) {
                ASSERT_EQ(shot.visibility.data[i], 0) << azimuth;
            } else if (m.traced.reference->state[i] == PixelState::Counted) {
                ASSERT_GT(glm::dot(m.traced.receivers->pixels[i].normal_ws, glm::dvec3(0, 1, 0)), 1e-6);
            }
    }
}

// The error at the right angle is about that at a degree less.
TEST(HardCase6, TheStageHasNoMoreErrorUnderALightStraightAbove) {
    const Scene scene = load_scene("stage");
    const auto iou = [&](double elevation) {
        Settings s;
        for (const auto& [key, value] : scene.suggested) set_setting(s, key, value);
        s.lights[0].elevation = elevation;
        ReferenceCache cache;
        return measure_error(hard_renderer(), scene, s, {.width = 320, .height = 180}, 0, {}, cache).metrics.iou;
    };
    EXPECT_NEAR(iou(90), iou(89.9), 0.05);
}

// Case 7: a light inside the geometry would need near <= 0.
TEST(HardCase7, ALightInsideABoxKeepsItsNearPlanePositive) {
    const Scene scene = floor_and_box(10, {1.5, 1, 2}, 0.25);
    for (LightType type : {LightType::Spot, LightType::Point})
        for (double distance : {1e-9, 0.05, 0.2, 0.5}) {
            Settings s = hard_settings();
            s.lights[0].type = type;
            s.lights[0].distance = distance;
            s.lights[0].elevation = 90;
            const Shot shot = draw_shot(scene, s);
            expect_within_limit(7, double(std::ranges::count_if(shot.light().views, [](const LightView& view) {
                                    return !(view.curve.near > 0);
                                })));
            expect_fault(7, shot.light().clipped_casters);
        }
    // From outside nothing is clipped, so the count is meaningful.
    Settings s = settings_with(hard_settings(), {"light.type=spot", "light.distance=20"});
    EXPECT_EQ(draw_shot(scene, s).light().clipped_casters, 0);
}

// Case 8: behind a spot the division by w mirrors the map onto the floor.
TEST(HardCase8, NothingIsMirroredBehindASpot) {
    const Scene scene = grey_scene({{"floor", make_plane(20, 20)}, {"wall", make_box({3, 3, 0.2}), moved(0, 1.5, -4)}});
    Settings s = settings_with(hard_settings(),
                               {"camera.distance=24", "camera.elevation=80", "light.type=spot", "light.azimuth=0",
                                "light.elevation=2", "light.cone=100", "light.distance=1.5"});
    // With the far guard on, depths behind the light also count as past its far plane. With it off, only the guard on
    // w remains.
    for (bool far_guard : {true, false})
        for (bool reversed : {false, true}) {
            s.map.far_guard = far_guard;
            s.map.reversed_z = reversed;
            const Shot shot = draw_shot(scene, s);
            ASSERT_EQ(shot.light().views.size(), 1u);
            const RayReference rays(scene);
            const LightView& view = shot.view();
            const FloatImage& map = shot.maps.at(0);
            int behind = 0, affected = 0, mirrored = 0;
            for (const auto& [x, y, hit] : pixel_hits(rays, shot)) {
                if (glm::dot(hit.normal, direction_to(shot.light(), hit.position)) <= 0) continue;
                const glm::dvec4 p = uvdw(view, hit.position);
                if (p.w > 0) continue;
                ++behind;
                affected += shot.visibility.at(x, y) != 1;
                if (p.x < 0 || p.x > 1 || p.y < 0 || p.y > 1) continue;
                // An unguarded test would compare these depths: rows of the map are read back from the top.
                const int u = std::min(int(p.x * map.width), map.width - 1);
                const int v = std::min(int((1 - p.y) * map.height), map.height - 1);
                mirrored += reversed ? p.z < map.at(u, v) : p.z > map.at(u, v);
            }
            EXPECT_GT(behind, 500) << "the case must show the floor behind the light";
            expect_fault(8, mirrored);
            expect_within_limit(8, affected);
        }
}

// Case 9: tan() of half the cone is 0 or enormous at the ends.
class HardCase9 : public testing::TestWithParam<double> {};

TEST_P(HardCase9, EverySpotAngleGivesFiniteMaps) {
    const Scene scene = floor_and_box(10, {1.5, 1, 2}, 0.5);
    Settings s = hard_settings();
    s.lights[0].type = LightType::Spot;
    s.lights[0].cone = GetParam();
    s.lights[0].distance = 6;
    const Shot shot = draw_shot(scene, s);
    EXPECT_TRUE(shot.light().casts);
    for (const LightView& view : shot.light().views) expect_within_limit(9, view.half_extent() / std::tan(1.5));
    const bool meaningful = GetParam() >= 60 && GetParam() <= 171;
    if (meaningful) {
        EXPECT_GT(shadow_share(shot), 0.01) << "the box must still cast";
    } else {
        EXPECT_FALSE(shot.frame.notes.empty()) << "a clamped cone must be reported";
    }
}

INSTANTIATE_TEST_SUITE_P(All, HardCase9,
                         testing::Values(0.0, 1e-4, 89.9, 90.0, 120.0, 170.0, 179.8, 180.0, 360.0, -30.0, double(NAN),
                                         double(INFINITY)),
                         [](const auto& named) {
                             std::string name;
                             for (char c : testing::PrintToString(named.param))
                                 name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                             return name;
                         });

TEST(HardCase9Vacuity, FloatTangentOfARightAngleIsNegative) {
    EXPECT_LT(std::tan(float(M_PI) / 2), 0);  // the value of an unclamped fit
    expect_fault(9, std::abs(std::tan(float(M_PI) / 2)));
}

}  // namespace
}  // namespace si::test
