// Tests that a face which is not in the map needs no bias: culled faces, objects that cast nothing, and surfaces before
// the near plane. Account, overlays, rows of the bias table and the pixel diagnosis agree on it.
#include "renderer/advise/bias_needs.h"
#include "renderer/inspect/pixel_diagnosis.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/biases.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"

namespace si {
namespace {

class MissingFaces : public FrameTest {
protected:
    const Scene boxes = load_scene("boxes");

    Settings without_bias(const Sets& extra) {
        return settings_for(
            boxes, joined({"map.resolution=512", "bias.kind=constant", "bias.constant=0", "bias.normal=0"}, extra));
    }
    MeasuredError measure(const Settings& s) {
        ReferenceCache cache;
        return measure_error(renderer, boxes, s, small_request(), 0, {}, cache);
    }
    static double amounts(const BiasSettings& b) {
        return b.constant + b.slope + b.normal + b.raster_slope + b.raster_units;
    }
    /// Returns the largest value of an overlay.
    double largest(const Settings& s, const char* overlay) {
        const FloatImage image = overlay_values(boxes, s, overlay);
        double most = 0;
        for (std::size_t i = 0; i < image.data.size(); i += 4)
            if (std::isfinite(image.data[i])) most = std::max(most, double(image.data[i]));
        return most;
    }
    std::string verdict(const Scene& scene, const Settings& s, glm::ivec2 pixel) {
        const Probe probe = renderer.probe(scene, s, small_request(), pixel.x, pixel.y);
        EXPECT_TRUE(probe.hit);
        const ReferenceScene casters(std::make_shared<ReferenceGeometry>(scene, s));
        return diagnose_pixel(probe, probe.lights.at(0),
                              trace_fragment_reference(casters, probe, probe.lights[0], s, object_traits(scene, s)), s,
                              renderer.driver())
            .verdict;
    }
};

TEST_F(MissingFaces, PicturesOfCulledFacesNeedNoBias) {
    const Settings both = without_bias({}), backs = without_bias({"caster.cull=front"});
    const MeasuredError measured = measure(backs);
    EXPECT_GT(bias_needs(measured, backs, renderer.driver()).pixels, 1000u)
        << "lit pixels are counted, and need nothing";
    for (const Bias& row : biases()) {
        SCOPED_TRACE(row.key);
        const auto needed = least_bias_of_row(row, measure(both), both, renderer.driver());
        ASSERT_TRUE(needed);
        if (!row.gives_needed_bias) {
            EXPECT_GT(amounts(*needed), 0.1);
        }
        const auto least = least_bias_of_row(row, measured, backs, renderer.driver());
        ASSERT_TRUE(least);
        EXPECT_EQ(amounts(*least), 0);
    }
}

TEST_F(MissingFaces, OverlaysShowThatTheyNeedNone) {
    EXPECT_GT(largest(without_bias({}), "least-bias"), 0.1);
    EXPECT_EQ(largest(without_bias({"caster.cull=front"}), "least-bias"), 0);
    // Without need all bias is slack.
    EXPECT_NEAR(largest(without_bias({"caster.cull=front", "bias.constant=2"}), "bias-slack"), 2, 1e-3);
    EXPECT_EQ(largest(without_bias({"caster.cull=front", "bias.kind=receiver-plane"}), "least-bias"), 0);
}

TEST_F(MissingFaces, RowsThatGiveTheNeededBiasGiveNone) {
    const ByteImage bare = picture(boxes, without_bias({"caster.cull=front"}));
    const ByteImage adaptive = picture(boxes, without_bias({"caster.cull=front", "bias.kind=adaptive"}));
    EXPECT_EQ(different_pixels(bare, adaptive), 0u);
    for (const Bias& row : biases()) {
        if (!row.gives_needed_bias) continue;
        const std::string kind = "bias.kind=" + std::string(row.key);
        EXPECT_LE(largest(without_bias({"caster.cull=front", kind}), "bias-slack"), 1e-3) << row.key;
    }
    const Settings both = without_bias({"bias.kind=adaptive"});
    EXPECT_GT(different_pixels(picture(boxes, both), picture(boxes, without_bias({}))), 1000u) << "acne without bias";
}

TEST_F(MissingFaces, ObjectsThatCastNothingNeedNone) {
    const Scene scene = test::floor_and_box();
    const std::string floor = scene.nodes[std::size_t(scene.objects[0].node)].path;
    Settings s = settings_with(test::texel_settings("pcf5", 256, 0), {"bias.kind=adaptive", "bias.normal=0"});
    s.objects[floor].cast = false;
    const glm::ivec2 corner(60, 150);
    const Probe probe = renderer.probe(scene, s, small_request(), corner.x, corner.y);
    ASSERT_EQ(probe.object, floor);
    EXPECT_FALSE(probe.lights.at(0).account.in_map);
    EXPECT_EQ(probe.lights[0].account.least.total(), 0);
    EXPECT_EQ(probe.lights[0].account.equivalent_depth(), 0);
    EXPECT_EQ(probe.lights[0].evidence.least, 0) << "the GPU's account";
    EXPECT_EQ(probe.lights[0].evidence.own, 0);
    EXPECT_NE(verdict(scene, s, corner).find("its object casts nothing"), std::string::npos);
    s.objects[floor].cast = true;
    EXPECT_GT(renderer.probe(scene, s, small_request(), corner.x, corner.y).lights.at(0).account.least.total(), 0);
}

TEST_F(MissingFaces, MirroredObjectsAreCulledByTheirOwnFronts) {
    for (const double x : {1.0, -1.0}) {
        const Scene scene = test::grey_scene(
            {{"floor", make_plane(8, 8)}, {"box", make_box({1, 1, 1}), glm::scale(glm::dmat4(1), {x, 1, 1})}});
        Settings s = settings_with(test::texel_settings("hard", 256, 0), {"caster.cull=front"});
        const FloatImage least = overlay_values(scene, s, "least-bias");
        double most = 0;
        for (std::size_t i = 0; i < least.data.size(); i += 4)
            if (std::isfinite(least.data[i])) most = std::max(most, double(least.data[i]));
        EXPECT_EQ(most, 0) << x;
        ReferenceCache cache;
        const MeasuredError m = measure_error(renderer, scene, s, small_request(), 0, {}, cache);
        const auto constant = std::ranges::find(biases(), "constant", &Bias::key);
        EXPECT_EQ(least_bias_of_row(*constant, m, s, renderer.driver()).value().constant, 0) << x;
    }
}

TEST_F(MissingFaces, SurfacesBeforeTheNearPlaneNeedNone) {
    const Scene scene = test::sheet_over_floor(3);
    Settings s = settings_with(test::texel_settings("pcf3", 256, 1),
                               {"light.elevation=90", "light.fit=manual", "light.distance=10", "light.extent=6",
                                "light.near_far=manual", "light.near=9", "light.far=20"});
    s.camera = orbiting_camera({0, 1.5, 0}, 0, 60, 8);
    const Probe probe = renderer.probe(scene, s, small_request(), 160, 90);
    ASSERT_EQ(probe.lights.at(0).place, MapPlace::BeforeNear) << probe.object;
    EXPECT_EQ(probe.lights[0].account.least.total(), 0);
    EXPECT_EQ(probe.lights[0].evidence.least, 0);
    EXPECT_NE(verdict(scene, s, {160, 90}).find("needs no bias, as it lies before the near plane"), std::string::npos)
        << verdict(scene, s, {160, 90});
}

TEST_F(MissingFaces, TheDiagnosisSaysThatTheFaceIsCulled) {
    Settings s = without_bias({"caster.cull=front", "bias.constant=1"});
    EXPECT_NE(verdict(boxes, s, {200, 130}).find("needs no bias, as its face is culled"), std::string::npos)
        << verdict(boxes, s, {200, 130});
}

}  // namespace
}  // namespace si
