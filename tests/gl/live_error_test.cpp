// Compares a frame's live error numbers with the same computed on the CPU.
#include "renderer/reference/live_error.h"

#include "renderer/bias/account.h"
#include "renderer/measure/measured_error.h"
#include "renderer/reference/artefact_picture.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/sets.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class LiveErrorTest : public FrameTest {
protected:
    ReferenceCache cache;
    Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    FrameRequest request{.width = 321, .height = 243, .outputs = {.colour = false, .error = true}};
    FrameResult frame;

    static Settings hard(int resolution, double constant) { return test::texel_settings("hard", resolution, constant); }

    /// Measures on both sides and expects equal numbers. @returns the CPU's numbers
    ErrorMetrics agree(const Settings& s, const char* what) {
        SCOPED_TRACE(what);
        frame = render_with_reference(renderer, scene, s, request, cache);
        EXPECT_TRUE(frame.reference.met);
        const ErrorMetrics cpu = measure_error(renderer, scene, s, request, 0, reference_options(s), cache).metrics;
        if (!frame.error) {
            ADD_FAILURE() << "no numbers";
            return cpu;
        }
        const ErrorMetrics& gpu = frame.error->metrics;
        EXPECT_EQ(gpu.counted, cpu.counted);
        EXPECT_EQ(gpu.pixels, cpu.pixels);
        EXPECT_EQ(gpu.artefacts, cpu.artefacts);
        const auto same_count = [&](double a, double b, const char* name) {
            EXPECT_EQ(std::llround(a * double(cpu.counted)), std::llround(b * double(cpu.counted))) << name;
        };
        same_count(gpu.false_shadow, cpu.false_shadow, "false shadow");
        same_count(gpu.false_light, cpu.false_light, "false light");
        same_count(gpu.acne, cpu.acne, "acne");
        same_count(gpu.leak, cpu.leak, "leak");
        same_count(gpu.light_bleeding, cpu.light_bleeding, "light bleeding");
        same_count(gpu.boundary_false_shadow, cpu.boundary_false_shadow, "boundary false shadow");
        same_count(gpu.boundary_false_light, cpu.boundary_false_light, "boundary false light");
        same_count(gpu.outside_false_shadow, cpu.outside_false_shadow, "outside false shadow");
        same_count(gpu.outside_false_light, cpu.outside_false_light, "outside false light");
        same_count(gpu.any_acne, cpu.any_acne, "any acne");
        same_count(gpu.visible_acne, cpu.visible_acne, "visible acne");
        EXPECT_TRUE(std::isnan(gpu.any_leak)) << "it takes rays";
        EXPECT_TRUE(cpu.any_leak >= 0);
        same_count(gpu.offset_false_shadow, cpu.offset_false_shadow, "offset false shadow");
        same_count(gpu.bias_false_light, cpu.bias_false_light, "bias false light");
        same_count(gpu.lost_false_light, cpu.lost_false_light, "lost false light");
        same_count(gpu.within_noise, cpu.within_noise, "within the noise");
        same_count(gpu.outside_map, cpu.outside_map, "outside the map");
        EXPECT_NEAR(gpu.mae, cpu.mae, 1e-5 * std::max(cpu.mae, 0.01));
        EXPECT_NEAR(gpu.rmse, cpu.rmse, 1e-5 * std::max(cpu.rmse, 0.01));
        EXPECT_NEAR(gpu.signed_mean, cpu.signed_mean, 1e-5 * std::max(cpu.mae, 0.01));
        EXPECT_NEAR(gpu.iou, cpu.iou, 1e-9);
        return cpu;
    }
};

SI_TEST_IS(Later, LiveErrorTest, AgreesWithTheCpuOnEveryArtefact);
TEST_F(LiveErrorTest, AgreesWithTheCpuOnEveryArtefact) {
    EXPECT_GT(agree(hard(512, 0), "no bias").acne, 0.3);
    Settings s = hard(256, 8);
    set_setting(s, "filter.kernel", "pcf3");
    EXPECT_GT(agree(s, "well biased").artefacts[std::size_t(Artefact::EdgeAliasing)], 10u);

    set_all(s, {"filter.kernel=vsm", "filter.blur=6", "filter.bleed=0", "bias.constant=0"});
    EXPECT_GT(agree(s, "light bleeding").light_bleeding, 0);

    s = hard(512, 3);
    set_all(s, {"light.fit=manual", "light.extent=1.2"});
    EXPECT_GT(agree(s, "outside of the map").outside_map, 0.3);
    s = settings_with(hard(512, 0), {"light.type=spot", "bias.normal=0.1", "bias.slope=0.05"});
    EXPECT_GT(agree(s, "spot light, too little of each bias").visible_acne, 0.001);
    s.lights[0].type = LightType::Point;
    EXPECT_GT(agree(s, "point light").counted, 1000u);

    scene = test::floor_and_box(10, {1.5, 1, 2}, 0.1);
    s = hard(1024, 3);
    s.bias.unit = BiasUnit::Metres;
    EXPECT_GT(agree(s, "peter-panning").artefacts[std::size_t(Artefact::PeterPanning)], 300u);
    set_all(s, {"light.type=spot", "map.reversed_z=true"});
    agree(s, "peter-panning under a spot light");

    scene = test::grey_scene({{"floor", make_plane(10, 10)}, {"sheet", make_plane(2, 2), moved(0, 1.2, 0)}});
    s = hard(512, 3);
    s.caster.cull = Cull::Front;
    EXPECT_GT(agree(s, "front culling").artefacts[std::size_t(Artefact::LostCaster)], 300u);
}

TEST_F(LiveErrorTest, AgreesUnderALightOfSizeAndOnPartOfThePixels) {
    Settings s =
        settings_with(hard(512, 0.5), {"filter.kernel=pcf5", "light.size=3", "truth.area=true", "truth.samples=64"});
    EXPECT_GT(agree(s, "light of size").mae, 0.001);
    const std::size_t all = frame.error->metrics.counted;
    for (const int step : {2, 3}) {
        s.truth.step = step;
        agree(s, "part of the pixels");
        EXPECT_NEAR(double(frame.error->metrics.counted) * step * step, double(all), 0.03 * double(all)) << step;
    }
}

TEST_F(LiveErrorTest, FollowsTheBiasWithoutNewRays) {
    Settings s = hard(512, 0);
    const double acne = agree(s, "before").acne;
    const auto reference = request.reference;
    for (const double constant : {1.0, 2.0, 4.0, 8.0}) {
        s.bias.constant = constant;
        frame = renderer.render(scene, s, request);  // without render_with_reference(): no rays may be traced
        ASSERT_TRUE(frame.reference.met);
        ASSERT_TRUE(frame.error);
        const ErrorMetrics& m = frame.error->metrics;
        EXPECT_LT(m.acne, 0.7 * acne + 1e-9) << constant;
    }
    EXPECT_EQ(frame.error->metrics.acne, 0);
    set_all(s, {"filter.kernel=pcf3", "bias.constant=0"});
    frame = renderer.render(scene, s, request);
    ASSERT_TRUE(frame.error);
    EXPECT_GT(frame.error->metrics.any_acne, acne) << "another kernel is measured at once";
    set_setting(s, "filter.kernel", "hard");
    s.lights[0].azimuth += 1;
    frame = renderer.render(scene, s, request);
    EXPECT_FALSE(frame.reference.met) << "another light needs another reference";
    EXPECT_FALSE(frame.error);
    EXPECT_EQ(request.reference, reference);
}

TEST_F(LiveErrorTest, OverlaysShowTheCountedPixels) {
    Settings s = hard(512, 0);
    set_setting(s, "view.overlay", "artefacts");
    request.outputs = {.colour = true, .overlay = true, .error = true};
    FrameResult untraced = renderer.render(scene, s, request);
    EXPECT_TRUE(untraced.panes.front().lacks_reference);
    EXPECT_EQ(untraced.panes.front().overlay, 0);
    EXPECT_NE(untraced.reference.key, 0u);
    frame = render_with_reference(renderer, scene, s, request, cache);
    EXPECT_EQ(untraced.reference.key, request.reference->key);
    const FloatImage values = renderer.read_float(frame.overlay, 4);
    for (const ArtefactStyle& style : artefact_styles()) {
        std::size_t pixels = 0;
        for (std::size_t i = 0; i < values.data.size(); i += 4) {
            bool same = values.data[i + 3] == 1;
            for (std::size_t c = 0; c < 3; ++c) same &= std::abs(values.data[i + c] * 255 - style.rgb[c]) < 0.01f;
            pixels += same;
        }
        EXPECT_EQ(pixels, frame.error->metrics.artefacts[std::size_t(style.artefact)]) << style.key;
    }

    const Reference& reference = *request.reference->traced.reference;
    set_setting(s, "view.overlay", "truth");
    frame = render_with_reference(renderer, scene, s, request, cache);
    const FloatImage shown = renderer.read_float(frame.overlay, 4);
    for (int y = 0; y < reference.height; ++y)
        for (int x = 0; x < reference.width; ++x)
            if (shown.at(x, y, 3) > 0) {
                ASSERT_EQ(shown.at(x, y), reference.visibility.at(x, y)) << x << ", " << y;
            }
    set_setting(s, "view.overlay", "truth-difference");
    frame = render_with_reference(renderer, scene, s, request, cache);
    const FloatImage difference = renderer.read_float(frame.overlay, 4);
    double sum = 0;
    std::size_t counted = 0;
    for (std::size_t i = 0; i < difference.data.size(); i += 4)
        if (difference.data[i + 3] > 0 && !std::isnan(difference.data[i])) {
            sum += difference.data[i];
            ++counted;
        }
    EXPECT_EQ(counted, frame.error->metrics.counted);
    EXPECT_NEAR(sum / double(counted), frame.error->metrics.signed_mean, 1e-6);
}

SI_TEST_IS(Later, LiveErrorTest, BiasWindowIsTheGapMinusThePlanesNeed);
TEST_F(LiveErrorTest, BiasWindowIsTheGapMinusThePlanesNeed) {
    scene = test::floor_and_box(10, {1.5, 1, 2}, 0);
    request.outputs = {.colour = false, .overlay = true};
    for (const LightType type : {LightType::Directional, LightType::Spot}) {
        Settings s = hard(128, 1);
        s.lights[0].type = type;
        set_setting(s, "filter.kernel", "pcf9");  // wide: needs more bias than the gap at the box allows
        set_setting(s, "view.overlay", "bias-window");
        frame = render_with_reference(renderer, scene, s, request, cache);
        ASSERT_FALSE(frame.panes.front().lacks_reference);
        const FloatImage shown = renderer.read_float(frame.overlay, 4);
        const Reference& reference = *request.reference->traced.reference;
        const FittedLight& light = frame.lights[0];
        std::size_t shadowed = 0, closed = 0, off = 0;
        for (int y = 0; y < reference.height; ++y)
            for (int x = 0; x < reference.width; ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(reference.width) + std::size_t(x);
                const float nearest = reference.nearest_m.data[i], value = shown.at(x, y);
                if (reference.state[i] != PixelState::Counted) continue;
                ASSERT_EQ(std::isnan(nearest), std::isnan(value)) << x << ", " << y;
                if (std::isnan(nearest)) continue;
                const Receiver& r = request.reference->traced.receivers->pixels[i];
                const BiasBreakdown account =
                    test::breakdown_at(frame, s, renderer.driver(), r.position_ws, r.normal_ws);
                const glm::dvec3 axis = light.views[account.receiver.view].axes[2];
                const double gap = nearest * glm::dot(account.receiver.to_light, axis) / account.receiver.texel_m;
                const double texels = gap - account.amount(account.least.total()).texels;
                ++shadowed;
                closed += texels <= 0;
                off += !(std::abs(value - texels) <= 0.02 + 2e-3 * std::abs(texels));
            }
        EXPECT_GT(shadowed, 1000u);
        EXPECT_GT(closed, 20u) << "at the box no bias is valid";
        EXPECT_LT(off, shadowed / 200) << int(type);
    }
}

TEST_F(LiveErrorTest, ReferencePictureIsShadedWithTheReference) {
    Settings s = hard(4096, 4);
    request.outputs = {.colour = true, .true_colour = true};
    frame = render_with_reference(renderer, scene, s, request, cache);
    ASSERT_NE(frame.true_colour.texture, 0u);
    const ByteImage map = renderer.read_colour(frame.colour), reference = renderer.read_colour(frame.true_colour);
    const std::size_t off = different_pixels(map, reference, 2);
    EXPECT_LT(off, map.data.size() / 4 / 50) << "a fine map is nearly true";
    set_all(s, {"bias.constant=0", "map.resolution=256"});
    frame = render_with_reference(renderer, scene, s, request, cache);
    EXPECT_EQ(reference.data, renderer.read_colour(frame.true_colour).data) << "the reference has no map";
    EXPECT_GT(different_pixels(renderer.read_colour(frame.colour), reference, 2), map.data.size() / 4 / 10);
}

}  // namespace
}  // namespace si
