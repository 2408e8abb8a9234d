// Tests measured errors of real frames: acne without bias, sampling errors that fall with resolution, lost casters.
#include "renderer/measure/measured_error.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class MeasureTest : public FrameTest {
protected:
    ReferenceCache cache;
    MeasuredError measured;
    const ErrorMetrics& measure(const Scene& scene, const Settings& settings, const ReferenceOptions& options = {},
                                int width = 320, int height = 240) {
        measured = measure_error(renderer, scene, settings, {.width = width, .height = height}, 0, options, cache);
        expect_sums_of_causes();
        return measured.metrics;
    }
    std::size_t count(Artefact a) const { return measured.metrics.artefacts[std::size_t(a)]; }
    /// Expects false shadow and false light to be the sums of their causes, to the pixel.
    void expect_sums_of_causes() const {
        const ErrorMetrics& m = measured.metrics;
        const auto px = [&](double share) { return std::llround(share * double(m.counted)); };
        EXPECT_EQ(px(m.false_shadow),
                  px(m.acne) + px(m.offset_false_shadow) + px(m.boundary_false_shadow) + px(m.outside_false_shadow));
        EXPECT_EQ(px(m.false_light), px(m.bias_false_light) + px(m.lost_false_light) + px(m.leak) +
                                         px(m.light_bleeding) + px(m.boundary_false_light) + px(m.outside_false_light));
        EXPECT_EQ(px(m.acne), (long long)count(Artefact::Acne));
        EXPECT_EQ(px(m.leak), (long long)count(Artefact::Leak));
        EXPECT_EQ(px(m.light_bleeding), (long long)count(Artefact::LightBleeding));
        EXPECT_EQ(px(m.boundary_false_shadow + m.boundary_false_light),
                  (long long)(count(Artefact::EdgeAliasing) + count(Artefact::Undersampled) +
                              count(Artefact::Penumbra) + count(Artefact::Filter)));
        std::size_t wrong = 0;
        for (std::size_t a = 1; a < kArtefacts; ++a) wrong += m.artefacts[a];
        EXPECT_EQ(px(m.false_shadow + m.false_light), (long long)wrong);
    }
    static Settings hard(int resolution) { return test::texel_settings("hard", resolution, 3); }
};

SI_TESTS_ARE(Repeated, MeasureTest);
TEST_F(MeasureTest, FindsNothingButEdgesInAWellBiasedFrame) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const char* kernel : {"hard", "pcf3"}) {
        Settings s = hard(512);
        set_setting(s, "filter.kernel", kernel);
        s.bias.constant = 8;
        const ErrorMetrics& m = measure(scene, s);
        EXPECT_GT(m.counted, 20000u);
        EXPECT_EQ(m.acne, 0) << kernel;
        EXPECT_EQ(m.lost_false_light, 0) << kernel;
        EXPECT_EQ(m.any_acne, 0) << kernel;
        EXPECT_GT(m.boundary_false_shadow + m.boundary_false_light, 0) << kernel << ": edges are never right";
        EXPECT_LT(m.mae, 0.03) << kernel;
        EXPECT_GT(m.iou, 0.9) << kernel;
        EXPECT_LT(m.boundary_px_mean, 1.5) << kernel;
        EXPECT_EQ(m.outside_map, 0) << kernel;
    }
}

/// Returns whether a surface point and 8 points around it on its plane are in shadow.
/// @param reach_m distance of the points along each axis of the map, metres across the light's rays
bool in_umbra(const test::RayReference& rays, const test::Hit& hit, const FittedLight& light, double reach_m) {
    const LightView& view = test::view_of(light, hit.position);
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y) {
            const glm::dvec3 aside = reach_m * (double(x) * view.axes[0] + double(y) * view.axes[1]);
            const glm::dvec3 moved = hit.position + aside;
            const glm::dvec3 ray = view.curve.perspective ? moved - view.eye : -view.axes[2];
            const glm::dvec3 on_plane = moved - ray * (glm::dot(aside, hit.normal) / glm::dot(ray, hit.normal));
            if (!rays.occluded(on_plane, light, hit.triangle)) return false;
        }
    return true;
}

// Culled front faces leave light inside the shadow where the kernel sees past the back faces.
SI_TEST_IS(Later, MeasureTest, CountsLightInFullShadowLikeBruteForce);
TEST_F(MeasureTest, CountsLightInFullShadowLikeBruteForce) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0);
    const test::RayReference rays(scene);
    for (const LightType type : {LightType::Directional, LightType::Spot})
        for (const bool blurred : {false, true}) {
            Settings s = test::texel_settings(blurred ? "esm" : "pcf3", blurred ? 512 : 128, 0);
            if (blurred)
                set_all(s, {"map.blur_texels=1", "filter.exponent=0.5"});  // lit nearly everywhere
            else
                s.caster.cull = Cull::Front;
            s.lights[0].type = type;
            const ErrorMetrics& m = measure(scene, s);
            const FittedLight& light = measured.lights[0];
            const double reach = blurred ? s.filter.blur + 1.0 + 1.0 : 2.0;
            EXPECT_EQ(measured.reach_texels, reach);
            long long expected = 0, differ = 0;
            for (const auto& [x, y, hit] : test::pixel_hits(rays, measured.camera, 320, 240)) {
                const std::size_t i = std::size_t(y) * 320 + std::size_t(x);
                if (measured.traced.reference->state[i] != PixelState::Counted) continue;
                const double texel_m =
                    test::view_of(light, hit.position).texel_size_at(hit.position, measured.map_resolution).longest;
                const bool leak =
                    measured.classified[i].visibility > 0.02f && in_umbra(rays, hit, light, reach * texel_m);
                expected += leak;
                differ += leak != measured.classified[i].any_leak;
            }
            EXPECT_GT(expected, 20) << int(type) << " " << blurred;
            EXPECT_LE(differ, 1) << "of " << expected << ": only rays that graze an edge differ";
            EXPECT_NEAR(m.any_leak * double(m.counted), double(expected), 1.001);
            // A second measurement finds the same in the memory of the reference.
            const double again =
                measure_error(renderer, scene, s, {.width = 320, .height = 240}, 0, {}, cache).metrics.any_leak;
            EXPECT_EQ(again, m.any_leak);
        }
}

// Samples on the light do not depend on which other pixels are asked.
TEST_F(MeasureTest, CountsLightInFullShadowOfAnAreaLight) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0);
    Settings s = test::texel_settings("pcf3", 128, 0);
    set_all(s, {"caster.cull=front", "light.size=1"});
    const ReferenceOptions area{.area = true, .samples = 64};
    const double share = measure(scene, s, area).any_leak;
    EXPECT_GT(share, 0);
    EXPECT_LT(share, measure(scene, s).any_leak) << "the umbra of a light with a size is smaller";
    cache.clear();
    EXPECT_EQ(measure(scene, s, area).any_leak, share);
}

TEST_F(MeasureTest, ClassifiesMissingBiasAsAcne) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = hard(512);
    s.bias.constant = 0;
    const ErrorMetrics& m = measure(scene, s);
    // On a plane without bias half of all texels lie before the plane.
    EXPECT_GT(m.false_shadow, 0.3);
    EXPECT_GT(m.acne, 0.95 * m.false_shadow);
    EXPECT_GE(m.any_acne, m.acne);
    EXPECT_LT(m.false_light, 0.01);
    EXPECT_LT(m.signed_mean, -0.3);
    std::size_t acne = 0;
    for (const ClassifiedPixel& p : measured.classified) acne += p.artefact == Artefact::Acne;
    EXPECT_EQ(acne, m.artefacts[std::size_t(Artefact::Acne)]);
    EXPECT_NEAR(double(acne) / double(m.counted), m.acne, 1e-12);
}

TEST_F(MeasureTest, ClassifiesTooMuchBiasAsPeterPanning) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.1);
    Settings s = hard(1024);
    s.bias.unit = BiasUnit::Metres;
    s.bias.constant = 3;  // more than the box's thickness along the light
    const ErrorMetrics& m = measure(scene, s);
    EXPECT_GT(m.bias_false_light, 0.01);
    EXPECT_EQ(m.acne, 0);
    EXPECT_GT(m.artefacts[std::size_t(Artefact::PeterPanning)], 300u);
    EXPECT_EQ(m.artefacts[std::size_t(Artefact::LostCaster)], 0u);
    EXPECT_GT(m.signed_mean, 0.01);
}

TEST_F(MeasureTest, ClassifiesCulledFacesAsLostCasters) {
    const Scene scene =
        test::grey_scene({{"floor", make_plane(10, 10)}, {"sheet", make_plane(2, 2), moved(0, 1.2, 0)}});
    Settings s = hard(512);
    EXPECT_EQ(measure(scene, s).lost_false_light, 0);
    s.caster.cull = Cull::Front;
    const ErrorMetrics& m = measure(scene, s);
    EXPECT_GT(m.lost_false_light, 0.01);
    EXPECT_GT(m.artefacts[std::size_t(Artefact::LostCaster)], 300u);
    EXPECT_EQ(m.artefacts[std::size_t(Artefact::PeterPanning)] + m.artefacts[std::size_t(Artefact::Leak)], 0u);
    EXPECT_LT(measure(scene, s, {.as_rasterised = true}).false_light, 0.01) << "without the faces that culling drops";
}

TEST_F(MeasureTest, CountsPointsOutsideTheMapSeparately) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = settings_with(hard(512), {"light.fit=manual", "light.extent=1.2"});
    const ErrorMetrics& m = measure(scene, s);
    EXPECT_GT(m.outside_map, 0.3);
    EXPECT_EQ(double(count(Artefact::OutsideMap)),
              std::round((m.outside_false_light + m.outside_false_shadow) * double(m.counted)))
        << "the wrong ones among them";
    EXPECT_EQ(m.acne, 0);
    EXPECT_EQ(m.leak, 0);
    EXPECT_GT(m.outside_false_light, 0) << "a part of the shadow falls outside";
}

SI_TEST_IS(DriverIndependent, MeasureTest, ErrorOfTheHardKernelFallsWithSlopeMinusOne);
TEST_F(MeasureTest, ErrorOfTheHardKernelFallsWithSlopeMinusOne) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    std::vector<double> x, y;
    for (const int resolution : {1024, 2048, 4096, 8192}) {
        Settings s = hard(resolution);
        s.camera.distance = 5;
        const ErrorMetrics& m = measure(scene, s, {}, 960, 720);
        EXPECT_EQ(m.acne, 0) << resolution;
        EXPECT_EQ(m.leak, 0) << resolution << ": one texel has no filter";
        x.push_back(std::log2(resolution));
        y.push_back(std::log2(m.false_shadow + m.false_light));
    }
    double mean_x = 0, mean_y = 0, xy = 0, xx = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / double(x.size());
        mean_y += y[i] / double(x.size());
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        xx += (x[i] - mean_x) * (x[i] - mean_x);
    }
    EXPECT_NEAR(xy / xx, -1, 0.2);
}

TEST_F(MeasureTest, TheReferenceIsCachedWhereOnlyTheMapChanges) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = hard(512);
    measure(scene, s);
    const auto reference = measured.traced.reference;
    EXPECT_GT(measured.traced.trace_ms, 0);
    set_all(s, {"map.resolution=1024", "filter.kernel=pcf5", "bias.constant=7"});
    measure(scene, s);
    EXPECT_EQ(measured.traced.reference, reference) << "a sweep over maps traces once";
    EXPECT_EQ(measured.traced.trace_ms, 0);
    s.lights[0].azimuth += 10;
    measure(scene, s);
    EXPECT_NE(measured.traced.reference, reference);
    EXPECT_EQ(measured.traced.build_ms, 0) << "the hierarchy stays";
    EXPECT_EQ(measured.traced.place_ms, 0) << "and what the camera sees";
    s.camera.azimuth += 10;
    measure(scene, s);
    EXPECT_GT(measured.traced.place_ms, 0);
    s.lights[0].azimuth -= 10;
    s.camera.azimuth -= 10;
    measure(scene, s);
    EXPECT_EQ(measured.traced.reference, reference) << "the last few are cached";
    const auto hard_reference = measured.traced.reference;
    s.lights[0].size = 2;
    measure(scene, s);
    EXPECT_EQ(measured.traced.reference, hard_reference) << "a point has no size";
    measure(scene, s, {.area = true, .samples = 64});
    EXPECT_NE(measured.traced.reference, hard_reference);
    EXPECT_GT(measured.traced.reference->partial, 100u);
}

}  // namespace
}  // namespace si
