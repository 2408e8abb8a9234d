// Tests the depth ranges of maps: ranges measured from the picture's depths, and pancaking on the near plane.
#include <algorithm>
#include <cmath>

#include "renderer/base/directions.h"
#include "renderer/measure/measure.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/fits.h"
#include "renderer/view/cameras/make_camera.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/ray_reference.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class ViewDepthsTest : public FrameTest {};

const FrameRequest kDepthPicture{.width = 160, .height = 90};

// ---- light.depth_bounds sdsm

SI_TESTS_ARE(Repeated, ViewDepthsTest);
SI_TEST_IS(Later, ViewDepthsTest, MeasuredBoundsEqualThoseOfReadBackDepths);
TEST_F(ViewDepthsTest, MeasuredBoundsEqualThoseOfReadBackDepths) {
    for (const char* name : {"stage", "landscape", "plane"})
        for (const Sets& camera : {Sets{},
                                   {"camera.source=manual", "camera.distance=4", "camera.elevation=12"},
                                   {"camera.source=manual", "camera.orthographic=true", "camera.height=5"}}) {
            Scene scene = load_scene(name);
            Settings s = settings_for(scene, camera);
            set_all(s, {"light.cascades=3", "light.depth_bounds=sdsm", "light.projection=auto",
                        "light.type=directional", "light.fit=casters", "map.resolution=64", "view.map_source=camera"});
            FrameRequest request = small_request({.colour = false, .shadow_map = true, .visibility = true});
            const FrameResult frame = renderer.render(scene, s, request);
            const FloatImage depths = renderer.read_map_view_depth(frame);
            double from = 1e300, to = -1e300;
            for (const float d : depths.data) {
                if (d == 0) continue;  // background
                const double z = frame.camera.curve.distance(d);
                from = std::min(from, z);
                to = std::max(to, z);
            }
            ASSERT_TRUE(frame.seen_m) << name;
            EXPECT_NEAR(frame.seen_m->from_m, from, 1e-4 * to) << name;
            EXPECT_NEAR(frame.seen_m->to_m, to, 1e-4 * to) << name;
            EXPECT_LE(frame.seen_m->from_m, from);
            EXPECT_GE(frame.seen_m->to_m, to);
            EXPECT_EQ(frame.lights[0].chooser.spans.back().ends, frame.seen_m->to_m);
            EXPECT_EQ(frame.passes.front().name, "visible depths");
            // The bounds are cached while nothing changes, and follow the camera.
            const FrameResult again = renderer.render(scene, s, request);
            EXPECT_EQ(again.passes.front().state, PassState::Cached);
            EXPECT_EQ(again.seen_m, frame.seen_m);
            EXPECT_EQ(again.lights[0].chooser.spans[0].ends, frame.lights[0].chooser.spans[0].ends);
        }
}

TEST_F(ViewDepthsTest, MeasuredBoundsMissLessThanBoxesOnTerrain) {
    const Scene scene = load_scene("landscape");
    Settings s = settings_for(scene, {"map.resolution=512", "light.cascades=4", "light.split=logarithmic"});
    Measurer measurer(renderer, 240, 135);
    const double boxes = measurer.classify(scene, s).error.mae;
    set_setting(s, "light.depth_bounds", "sdsm");
    const Classification measured = measurer.classify(scene, s);
    EXPECT_LT(measured.error.mae, 0.85 * boxes);
    EXPECT_EQ(measured.error.outside_map, 0);
    RecordProperty("mae", std::to_string(boxes) + " " + std::to_string(measured.error.mae));
}

TEST_F(ViewDepthsTest, MeasuredBoundsHoldBlendedSurfaces) {
    Scene scene;
    scene.materials.push_back({.name = "glass", .base_colour = {1, 1, 1, 0.9f}, .alpha = AlphaMode::Blend});
    scene.meshes = {make_quad(4, 4), make_quad(60, 60), make_box(glm::dvec3(1.2))};
    scene.meshes[0].material = 0;
    // The box is beside the picture; its shadow falls on the glass, which stands before all opaque surfaces.
    scene.nodes = {
        {.name = "glass"}, {.name = "wall", .local = moved(0, 0, -20)}, {.name = "box", .local = moved(5.1, 1.05, 3)}};
    scene.objects = {{.node = 0, .mesh = 0}, {.node = 1, .mesh = 1}, {.node = 2, .mesh = 2}};
    finalise(scene);
    for (const char* bounds : {"boxes", "sdsm"}) {
        Settings s = settings_for(
            scene, {"map.resolution=512", "light.azimuth=60", "light.elevation=10", "light.fit=view",
                    "camera.source=manual", "camera.azimuth=0", "camera.elevation=0", "camera.distance=6"});
        set_setting(s, "light.depth_bounds", bounds);
        const ByteImage shadowed = renderer.read_colour(renderer.render(scene, s, kDepthPicture).colour);
        s.lights[0].cast = false;
        const ByteImage lit = renderer.read_colour(renderer.render(scene, s, kDepthPicture).colour);
        EXPECT_GT(different_pixels(shadowed, lit, 8), 100u) << bounds;
    }
}

// ---- light.near_far

/// Makes a visible floor, and a sheet outside the picture, 30 m towards the light.
Scene floor_under_far_sheet(const test::Place& place) {
    const glm::dvec3 at = 30.0 * direction_from_angles(place.azimuth, place.elevation);
    Scene scene =
        test::grey_scene({{"floor", make_plane(10, 10)}, {"sheet", make_plane(3, 3), moved(at.x, at.y, at.z)}});
    test::move_scene(scene, place.at);
    return scene;
}

/// Returns settings with a sun whose maps for the view frustum hold only the floor.
Settings far_sheet_settings(const Scene& scene, const test::Place& place, const char* fit, int cascades) {
    Settings s = test::texel_settings("pcf3", 256, 3);
    set_setting(s, "light.fit", fit);
    s.lights[0].azimuth = place.azimuth;
    s.lights[0].elevation = place.elevation;
    s.lights[0].cascades = cascades;
    const glm::dvec3 target = place.at - scene.bounds.centre();
    set_target(s.camera, place.at);
    set_target(s.lights[0], target);
    return s;
}

double range_of(const LightView& view) {
    return view.curve.far - view.curve.near;
}

/// Returns the distance along the light from the view's position.
double depth_of(const LightView& view, const glm::dvec3& at) {
    return glm::dot(view.eye - at, view.axes[2]);
}

TEST_F(ViewDepthsTest, PancakingGivesTheSameShadowFromAShorterRange) {
    for (const test::Place& place : test::kPlaces)
        for (const auto& [fit, cascades] : {std::pair{"view", 1}, {"casters", 3}}) {
            SCOPED_TRACE(testing::Message() << fit << " " << cascades << " " << place.elevation);
            const Scene scene = floor_under_far_sheet(place);
            const Settings whole = far_sheet_settings(scene, place, fit, cascades);
            for (const Sets& bias : {Sets{},
                                     {"bias.kind=constant", "bias.unit=metres", "bias.constant=0.4"},
                                     {"bias.normal=4", "map.reversed_z=true"},
                                     {"bias.kind=receiver-plane", "bias.constant=0.5"}}) {
                Settings s = whole;
                set_all(s, bias);
                FrameResult wide, flat;
                const FloatImage wanted = visibility(scene, s, kDepthPicture, &wide);
                set_setting(s, "light.near_far", "pancaking");
                const FloatImage drawn = visibility(scene, s, kDepthPicture, &flat);
                const auto dark = std::ranges::count(wanted.data, 0.f);
                EXPECT_GT(dark, 500);
                EXPECT_EQ(differing_values(wanted, drawn, 1e-3f), 0u) << (bias.empty() ? "" : bias[0].second);
                EXPECT_EQ(flat.lights[0].clipped_casters, 0) << "none is lost";
                for (std::size_t v = 0; v < flat.lights[0].views.size(); ++v) {
                    const LightView &a = wide.lights[0].views[v], &b = flat.lights[0].views[v];
                    EXPECT_GT(range_of(a), 30);
                    EXPECT_LT(range_of(b), 0.6 * range_of(a));
                    // The near plane lies between the sheet and the floor; straight below the sun that is one depth.
                    const double sheet =
                        depth_of(b, place.at + 30.0 * direction_from_angles(place.azimuth, place.elevation));
                    EXPECT_GT(b.curve.near, sheet + 10);
                    if (place.elevation == 90) {
                        EXPECT_NEAR(b.curve.far, sheet + 30, 0.1);
                    }
                    EXPECT_EQ(a.half_extent(), b.half_extent());
                }
            }
        }
}

// The map no longer stores the sheet's height above the floor.
TEST_F(ViewDepthsTest, PancakingNarrowsPenumbrae) {
    const test::Place place = test::kPlaces[0];
    const Scene scene = floor_under_far_sheet(place);
    Settings s = far_sheet_settings(scene, place, "view", 1);
    s.filter.kernel = test::kernel_row("pcss");
    s.lights[0].size = 0.4;
    const auto grey = [&] { return values_between(visibility(scene, s, kDepthPicture), 0.02f, 0.98f); };
    const auto wide = grey();
    set_setting(s, "light.near_far", "pancaking");
    const auto narrow = grey();
    EXPECT_GT(wide, 300);
    EXPECT_LT(double(narrow), 0.5 * double(wide));
    set_setting(s, "light.near_far", "casters");
    EXPECT_NEAR(double(grey()), double(wide), 0.05 * double(wide));
}

TEST_F(ViewDepthsTest, EachChoiceHasItsRange) {
    for (const test::Place& place : test::kPlaces) {
        SCOPED_TRACE(place.elevation);
        const Scene scene = floor_under_far_sheet(place);
        Settings s = far_sheet_settings(scene, place, "view", 1);
        const glm::dvec3 way = direction_from_angles(place.azimuth, place.elevation);
        FrameResult frame;
        const FloatImage fitted = visibility(scene, s, kDepthPicture, &frame);
        for (const char* choice : {"casters", "scene"}) {
            set_setting(s, "light.near_far", choice);
            EXPECT_EQ(differing_values(fitted, visibility(scene, s, kDepthPicture, &frame), 1e-3f), 0u) << choice;
        }
        // The range goes from the sheet's near rim to the floor's far rim: half the diagonals of surfaces askew to the
        // light.
        const double along = std::abs(way.x) + std::abs(way.z);
        const LightView& all = frame.lights[0].views[0];
        EXPECT_NEAR(all.curve.near, depth_of(all, place.at + 30.0 * way) - 1.5 * along, 0.01);
        EXPECT_NEAR(all.curve.far, depth_of(all, place.at) + 5 * along, 0.01);
        // Manual ranges hold for every fit and for cascades; a near plane behind the sheet loses the sheet.
        for (const int cascades : {1, 3}) {
            set_setting(s, "light.near_far", "manual");
            s.lights[0].cascades = cascades;
            s.lights[0].near = depth_of(all, place.at) - 9;
            s.lights[0].far = depth_of(all, place.at) + 8;
            const FloatImage cut = visibility(scene, s, kDepthPicture, &frame);
            for (const LightView& view : frame.lights[0].views) EXPECT_NEAR(range_of(view), 17, 1e-9);
            EXPECT_EQ(std::ranges::count_if(cut.data, [](float v) { return v < 0.5f; }), 0);
            EXPECT_EQ(frame.lights[0].clipped_casters, 1);
        }
    }
}

TEST_F(ViewDepthsTest, PancakingWorksForSpotAndPointLights) {
    Scene scene = test::floor_under_sheet({});
    for (const char* type : {"spot", "point"})
        for (const char* reversed : {"false", "true"}) {
            Settings s = test::texel_settings("pcf3", 256, 3);
            set_all(s, {{"light.type", type},
                        "light.distance=4",
                        "light.elevation=90",
                        {"map.reversed_z", reversed},
                        "object.cover.receive=false"});
            FrameResult wide, flat;
            const FloatImage wanted = visibility(scene, s, kDepthPicture, &wide);
            set_setting(s, "light.near_far", "pancaking");
            const FloatImage drawn = visibility(scene, s, kDepthPicture, &flat);
            EXPECT_GT(std::ranges::count(wanted.data, 0.f), 300);
            EXPECT_EQ(differing_values(wanted, drawn, 1e-3f), 0u) << type;
            const auto lowest = [](const FrameResult& f) {
                double near = 0;
                for (const LightView& v : f.lights[0].views) near = std::max(near, v.curve.near);
                return near;
            };
            EXPECT_GT(lowest(flat), 1.4 * lowest(wide)) << type;
        }
}

// ---- the camera that maps are made for

TEST_F(ViewDepthsTest, MapsAreMadeForTheFrozenCamera) {
    const Scene scene = load_scene("stage");
    for (const char* bounds : {"boxes", "sdsm"})
        for (const Sets& fit : {Sets{"light.cascades=3"}, {"light.fit=view"}}) {
            Settings s = settings_for(
                scene,
                {"camera.source=manual", "camera.distance=5", "map.resolution=256", {"light.depth_bounds", bounds}});
            set_all(s, fit);
            FrameRequest request = small_request({.colour = false, .visibility = true});
            const FrameResult own = renderer.render(scene, s, request);
            s.camera.azimuth += 120;
            s.camera.distance = 14;
            const FrameResult moved = renderer.render(scene, s, request);
            request.map_camera = MapCamera{own.camera, own.seen_m};
            const FrameResult frozen = renderer.render(scene, s, request);
            EXPECT_EQ(frozen.camera.eye, moved.camera.eye);
            ASSERT_EQ(frozen.lights[0].views.size(), own.lights[0].views.size());
            for (std::size_t v = 0; v < own.lights[0].views.size(); ++v) {
                EXPECT_EQ(frozen.lights[0].views[v].clip_from_relative(own.camera.eye),
                          own.lights[0].views[v].clip_from_relative(own.camera.eye));
                EXPECT_NE(moved.lights[0].views[v].half_extent(), own.lights[0].views[v].half_extent());
            }
            EXPECT_EQ(frozen.lights[0].chooser.from_ws, own.lights[0].chooser.from_ws);
            EXPECT_EQ(frozen.notes, own.notes);
        }
}

// Maps are made for a camera that turns and moves by fractions of a texel, and a fixed camera draws with them. The
// picture stays equal except at borders of texels and cascades.
TEST_F(ViewDepthsTest, StabilisedShadowsDoNotShimmer) {
    const Scene scene = load_scene("boxes");
    const auto flips = [&](const char* fit) {
        Settings s = settings_for(scene, {"light.cascades=2",
                                          "light.cascade_blend=0",
                                          {"light.fit", fit},
                                          "filter.kernel=hard",
                                          "bias.kind=constant",
                                          "bias.constant=4",
                                          "map.resolution=256"});
        Settings walking = settings_with(s, {"camera.source=manual", "camera.distance=3"});
        FrameRequest request{.width = 160, .height = 90, .outputs = {.colour = false, .visibility = true}};
        std::vector<float> before;
        std::vector<std::size_t> chosen_before;
        std::size_t count = 0;
        test::RayReference rays(scene);
        std::vector<std::optional<test::Hit>> hits;
        for (int i = 0; i < 120; ++i) {
            walking.camera.target_x += 0.0011;
            walking.camera.target_z -= 0.0007;
            if (i >= 60) walking.camera.azimuth += 6;
            request.map_camera = MapCamera{make_camera(scene, walking, 16.0 / 9), {}};
            const FrameResult frame = renderer.render(scene, s, request);
            const FloatImage v = renderer.read_float(frame.visibility, 1);
            if (hits.empty())
                for (const test::PixelRay& ray : test::pixel_rays(frame.camera, 160, 90))
                    hits.push_back(rays.first_hit(ray.origin, ray.direction));
            // Points on a texel's border and the background are left out.
            std::vector<std::size_t> chosen;
            for (const auto& hit : hits) {
                chosen.push_back(99 + chosen.size());
                if (!hit) continue;
                const std::size_t view = frame.lights[0].chooser.choose(frame.lights[0].views, hit->position).view;
                const glm::dvec2 part =
                    glm::fract(256.0 * glm::dvec2(test::uvdw(frame.lights[0].views[view], hit->position)));
                if (std::min({part.x, part.y, 1 - part.x, 1 - part.y}) > 2e-3) chosen.back() = view;
            }
            for (std::size_t k = 0; k < before.size(); ++k)
                count += chosen[k] < 99 && chosen[k] == chosen_before[k] && v.data[k] != before[k];
            before = v.data;
            chosen_before = chosen;
        }
        return count;
    };
    const std::size_t steady = flips("stabilised"), tight = flips("view");
    RecordProperty("flips", std::to_string(steady) + " " + std::to_string(tight));
    EXPECT_GT(tight, 1500u);
    // Rasterisers snap vertices to fractions of a texel: an edge through a texel's centre may still flip it.
    EXPECT_LE(steady, tight / 50) << "of " << 119 * 160 * 90;
}

}  // namespace
}  // namespace si
