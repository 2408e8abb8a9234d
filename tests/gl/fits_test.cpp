// Tests maps fitted to the caster region: points outside are lit in the reference and the picture, and texels are
// finer.
#include "renderer/settings/fits.h"

#include <algorithm>
#include <random>

#include "app/report/map_report.h"
#include "renderer/measure/measured_error.h"
#include "renderer/scene/ground.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class FitsTest : public FrameTest {
protected:
    ReferenceCache cache;

    struct Comparison {
        std::size_t beyond = 0, shadowed_beyond = 0, unlit_beyond = 0, shadowed = 0;
        ErrorMetrics metrics;
        FittedLight light;
    };

    /// Compares every pixel's visibility with the hard reference.
    Comparison compare_with_reference(const Scene& scene, const Settings& s, int width = 240, int height = 135) {
        FrameRequest request{.width = width,
                             .height = height,
                             .outputs = {.colour = false, .visibility = true, .map_coordinates = true}};
        const FrameResult frame = renderer.render(scene, s, request);
        const FloatImage coordinates = renderer.read_float(frame.map_coordinates, 4);
        const FloatImage visibility = renderer.read_float(frame.visibility, 1);
        request.outputs = {.colour = false};
        const MeasuredError measured = measure_error(renderer, scene, s, request, 0, {}, cache);
        const Reference& reference = *measured.traced.reference;
        Comparison out{.metrics = measured.metrics, .light = frame.lights.at(0)};
        const FloatImage& hard = reference.hard();
        for (std::size_t i = 0; i < reference.state.size(); ++i) {
            if (reference.state[i] != PixelState::Counted) continue;
            const bool shadow = hard.data[i] < 0.5f;
            out.shadowed += shadow;
            if (coordinates.data[4 * i + 3] > 0) continue;
            ++out.beyond;
            out.shadowed_beyond += shadow;
            out.unlit_beyond += visibility.data[i] != 1.f;
        }
        return out;
    }
};

SI_TESTS_ARE(Repeated, FitsTest);
SI_TEST_IS(DriverIndependent, FitsTest, PointsOutsideTheMapAreLitInTheReferenceOverAllScenesAndDirections);
SI_TEST_IS(Product, FitsTest, PointsOutsideTheMapAreLitInTheReferenceOverAllScenesAndDirections);
SI_TEST_IS(Slow, FitsTest, PointsOutsideTheMapAreLitInTheReferenceOverAllScenesAndDirections);
TEST_F(FitsTest, PointsOutsideTheMapAreLitInTheReferenceOverAllScenesAndDirections) {
    struct Sun {
        const char *azimuth, *elevation;
    };
    std::vector<Sets> lights = {{"light.type=spot", "light.cone=50", "light.elevation=60"},
                                {"light.type=spot", "light.cone=100", "light.azimuth=90"}};
    for (const Sun& sun : {Sun{"0", "90"}, Sun{"90", "20"}, Sun{"180", "45"}, Sun{"-33", "62"}})
        lights.push_back({{"light.azimuth", sun.azimuth}, {"light.elevation", sun.elevation}});
    std::vector<std::string> scenes, narrowing;
    for (const BuiltinScene& row : builtin_scenes()) scenes.emplace_back(row.key);
    for (const FitRow& fit : fits())
        if (fit.narrows) narrowing.emplace_back(fit.key);
    for (const auto& [name, given, fit] : test::combinations(scenes, lights, narrowing)) {
        SCOPED_TRACE(name + " " + given[0].second + " " + given[1].second + " " + fit);
        const Scene scene = load_scene(name);
        Sets light = given;
        light.emplace_back("map.resolution", "1024");
        light.emplace_back("light.fit", "scene");
        const Comparison whole = compare_with_reference(scene, settings_for(scene, light));
        light.back().second = fit;
        const Comparison j = compare_with_reference(scene, settings_for(scene, light));
        EXPECT_EQ(j.shadowed_beyond, 0u) << "of " << j.beyond;
        EXPECT_EQ(j.unlit_beyond, 0u);
        EXPECT_TRUE(j.metrics.outside_map == 0 || !j.light.closed);
        EXPECT_LE(j.metrics.mae, 1.1 * whole.metrics.mae + 2e-3) << "a map that holds less holds it finer";
        EXPECT_LE(j.light.views[0].half_extent(), 1.05 * whole.light.views[0].half_extent());
    }
}

SI_TEST_IS(DriverIndependent, FitsTest, PointsOutsideTheMapAreLitInTheReferenceUnderRandomCameras);
SI_TEST_IS(Slow, FitsTest, PointsOutsideTheMapAreLitInTheReferenceUnderRandomCameras);
// Cameras stand anywhere, also within the scene: none of their pixels outside the map is in shadow.
TEST_F(FitsTest, PointsOutsideTheMapAreLitInTheReferenceUnderRandomCameras) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::size_t beyond = 0, shadowed = 0;
    int closed = 0, open = 0;
    for (const char* name : {"boxes", "stage", "figures"}) {
        const Scene scene = load_scene(name);
        const double r = scene.bounds.radius();
        for (int i = 0; i < 16; ++i) {
            SCOPED_TRACE(testing::Message() << name << " " << i);
            Settings s = settings_for(scene, {"map.resolution=512", "light.fit=view"});
            LightSettings& light = s.lights[0];
            light.azimuth = i % 3 == 0 ? 90 * (i % 4) : 180 * unit(random);
            light.elevation = i % 5 == 0 ? 90 : 15 + 60 * std::abs(unit(random));
            if (i % 4 == 3) {
                light.type = LightType::Spot;
                light.cone = 70 + 30 * unit(random);
                light.distance = i % 8 == 3 ? 0 : 0.3 * r;  // above the scene, or inside it
            }
            CameraSettings& camera = s.camera;
            camera.source = CameraSource::Manual;
            const glm::dvec3 at = scene.bounds.centre() + 0.4 * r * glm::dvec3(unit(random), 0, unit(random));
            set_target(camera, at);
            camera.azimuth = 180 * unit(random);
            camera.elevation = i == 7 ? -60 : 10 + 60 * std::abs(unit(random));
            camera.distance = r * (i % 2 ? 0.15 : 1.2);
            camera.fov = i % 5 == 4 ? 15 : 55;
            camera.orthographic = i % 6 == 1;
            camera.height = 0.6 * r;
            const Comparison j = compare_with_reference(scene, s, 112, 63);
            EXPECT_EQ(j.shadowed_beyond, 0u) << "of " << j.beyond;
            EXPECT_EQ(j.unlit_beyond, 0u);
            beyond += j.beyond;
            shadowed += j.shadowed;
            (j.light.closed ? closed : open) += 1;
        }
    }
    EXPECT_GT(beyond, 5000u);
    EXPECT_GT(shadowed, 10000u);
    EXPECT_GT(closed, 35);
    RecordProperty("cases", std::to_string(closed) + " " + std::to_string(open));
}

SI_TEST_IS(Slow, FitsTest, WrapAndOutsideModesChangeNothingOutsideTheCasterRegion);
TEST_F(FitsTest, WrapAndOutsideModesChangeNothingOutsideTheCasterRegion) {
    Scene scene = test::floor_and_box(10, {1.5, 1, 2});
    for (const char* wrap : {"border", "clamp", "repeat", "range"})
        for (const char* outside : {"lit", "unlit"}) {
            SCOPED_TRACE(std::string(wrap) + " " + outside);
            Settings s = test::texel_settings("pcf3", 512, 3);
            set_all(s, {{"map.wrap", wrap}, {"map.outside", outside}, "light.fit=casters", "bias.normal=0"});
            const Comparison j = compare_with_reference(scene, s);
            EXPECT_TRUE(j.light.closed);
            EXPECT_GT(j.beyond, 3000u) << "the floor is much wider than the box";
            EXPECT_EQ(j.unlit_beyond, 0u);
            EXPECT_EQ(j.metrics.outside_map, 0);
            EXPECT_GT(j.shadowed, 300u);
            // The same map with manual settings has an outside.
            s.lights[0].fit = LightFit::Manual;
            s.lights[0].extent = j.light.views[0].half_extent();
            EXPECT_GT(compare_with_reference(scene, s).metrics.outside_map, 0.1);
        }
}

TEST_F(FitsTest, KernelsAreCompleteAtTheMapsRim) {
    // Seen from straight above, the edges of the box's shadow lie on the region's sides. The kernel's penumbra outside
    // must not be cut off. The same map with manual settings has no such border.
    Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.5);
    for (const char* kernel : {"hard", "pcf3", "pcf9"}) {
        SCOPED_TRACE(kernel);
        Settings s = settings_with(test::texel_settings(kernel, 128, 8),
                                   {"light.elevation=90", "light.azimuth=0", "light.fit=casters"});
        FrameRequest request{.width = 300, .height = 200, .outputs = {.colour = false, .visibility = true}};
        const FrameResult frame = renderer.render(scene, s, request);
        ASSERT_TRUE(frame.lights[0].closed);
        const FloatImage narrowed = renderer.read_float(frame.visibility, 1);
        const LightView view = frame.lights[0].views[0];
        LightSettings& light = s.lights[0];
        light.fit = LightFit::Manual;
        light.extent = view.half_extent();
        const glm::dvec3 aside = view.eye - frame.lights[0].position;
        set_target(light, aside);
        const FrameResult by_hand = renderer.render(scene, s, request);
        ASSERT_NEAR(by_hand.lights[0].views[0].half_extent(), view.half_extent(), 1e-9);
        const FloatImage read = renderer.read_float(by_hand.visibility, 1);
        std::size_t differs = 0, grey = 0;
        for (std::size_t i = 0; i < read.data.size(); ++i) {
            differs += std::abs(read.data[i] - narrowed.data[i]) > 1e-3f;
            grey += read.data[i] > 0.01f && read.data[i] < 0.99f;
        }
        EXPECT_EQ(differs, 0u);
        EXPECT_EQ(grey > 50, std::string(kernel) != "hard") << grey;
    }
}

TEST_F(FitsTest, TheStageReadsTwiceTheShareOfItsTexels) {
    const Scene scene = load_scene("stage");
    FrameRequest request{.width = 1280, .height = 720};
    const auto share = [&](const char* fit) {
        return map_report(renderer, scene, settings_for(scene, {{"light.fit", fit}}), request)->usage.utilisation();
    };
    const double scene_fit = share("scene"), casters = share("casters"), view = share("view");
    RecordProperty("shares", std::to_string(scene_fit) + " " + std::to_string(casters) + " " + std::to_string(view));
    EXPECT_GE(casters, 2 * scene_fit) << scene_fit << " -> " << casters;
    EXPECT_GE(view, 0.9 * casters) << view;
    EXPECT_EQ(fit_row(LightSettings().fit).key, "casters") << "what the program starts with";
}

TEST_F(FitsTest, OnlyTheViewFitFollowsTheCamera) {
    const Scene scene = load_scene("stage");
    const auto half_width = [&](const char* fit, const char* azimuth) {
        const Settings s = settings_for(
            scene, {{"light.fit", fit}, "camera.source=manual", "camera.distance=4", {"camera.azimuth", azimuth}});
        const FrameResult frame = renderer.render(scene, s, small_request());
        EXPECT_TRUE(frame.lights[0].closed);
        return std::pair(frame.lights[0].views[0].half_extent(), frame.lights[0].views[0].eye);
    };
    EXPECT_EQ(half_width("casters", "0"), half_width("casters", "130"));
    EXPECT_NE(half_width("view", "0"), half_width("view", "130"));
    EXPECT_LT(half_width("view", "0").first, half_width("casters", "0").first);
}

TEST_F(FitsTest, AProbeReportsPointsThatNoCasterCanShadow) {
    Scene scene = test::floor_and_box(10, {1.5, 1, 2});
    Settings s = test::texel_settings("pcf3", 512, 3);
    s.lights[0].fit = LightFit::Casters;
    const FrameRequest request{.width = 240, .height = 180};
    FrameRequest drawn = request;
    drawn.outputs = {.map_coordinates = true};
    const FloatImage coordinates = renderer.read_float(renderer.render(scene, s, drawn).map_coordinates, 4);
    int beyond = 0, inside = 0;
    for (int y = 5; y < 180; y += 25)
        for (int x = 5; x < 240; x += 25) {
            const Probe probe = renderer.probe(scene, s, request, x, y);
            if (!probe.hit || !faces_light(probe.lights[0].account.receiver.n_dot_l)) continue;
            const Probe::PerLight& p = probe.lights[0];
            const bool reads = coordinates.data[4 * std::size_t(y * 240 + x) + 3] > 0;
            EXPECT_EQ(p.place == MapPlace::OutsideCasterRegion, !reads) << x << " " << y << " " << place_name(p.place);
            (reads ? inside : beyond) += 1;
            if (reads) continue;
            EXPECT_EQ(p.visibility, 1);
            EXPECT_TRUE(p.taps.empty());
            EXPECT_EQ(p.evidence.place, CauseEvidence::kInside) << "that is no artefact";
            EXPECT_NE(p.verdict.find("nothing can cast a shadow"), std::string::npos) << p.verdict;
        }
    EXPECT_GT(beyond, 5);
    EXPECT_GT(inside, 3);
}

// A frame depends on its own settings alone, not on those of the frame before.
TEST_F(FitsTest, ChangedKernelsAndOffsetsFitMapsAsAFreshRendererDoes) {
    Scene model;
    add_object(model, "Box", -1, add_mesh(model, "Box", make_box(glm::dvec3(1)), -1), moved(30, 0.5, -20));
    finalise(model);
    add_ground(model);
    const Scene stage = load_scene("stage");
    struct Change {
        const Scene& scene;
        Sets before, after;
    };
    std::vector<Change> changes = {{model, {"filter.kernel=hard"}, {"filter.kernel=pcf", "filter.size=9"}},
                                   {stage,
                                    {"light.fit=lispsm", "filter.kernel=pcf3", "bias.normal=2"},
                                    {"light.fit=lispsm", "filter.kernel=pcf5", "bias.normal=1"}}};
    for (const char* normal : {"bias.normal=0.02", "bias.normal=0.05", "bias.normal=0.1", "bias.normal=0.2"}) {
        const Sets common = {"map.resolution=512", "bias.normal_unit=metres", normal};
        Change metres{stage, common, common};
        metres.before.push_back("filter.kernel=hard");
        metres.after.push_back("filter.kernel=pcf5");
        changes.push_back(metres);
    }
    for (const Change& c : changes) {
        const auto fitted = [&](Renderer& by, const Sets& sets) {
            return by.render(c.scene, settings_for(c.scene, sets), small_request({.colour = false, .shadow_map = true}))
                .lights.at(0)
                .views.at(0);
        };
        fitted(renderer, c.before);
        const LightView view = fitted(renderer, c.after);
        Renderer fresh;
        const LightView alone = fitted(fresh, c.after);
        EXPECT_EQ(view.projection, alone.projection) << c.after.back().second;
        EXPECT_EQ(view.eye, alone.eye) << c.after.back().second;
        EXPECT_EQ(view.curve.far, alone.curve.far) << c.after.back().second;
    }
}

}  // namespace
}  // namespace si
