// Tests of FLIP between the picture and the picture with the reference's shadows: metric, live error and overlay.
#include "renderer/reference/flip.h"

#include "renderer/measure/measured_error.h"
#include "renderer/reference/live_error.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"

namespace si {
namespace {

class FlipFrameTest : public FrameTest {
protected:
    ReferenceCache cache;
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    FrameRequest request = small_request();

    double measured_flip(const Settings& s) {
        return measure_error(renderer, scene, s, request, 0, reference_options(s), cache, {}, true).metrics.flip;
    }
    /// Returns FLIP of the picture and the picture with the reference's shadows, without the measured code.
    Flip flip_of_pictures(Settings s) {
        s.view.overlay = 0;
        FrameRequest pair = request;
        pair.outputs = {.colour = true, .true_colour = true};
        const FrameResult frame = render_with_reference(renderer, scene, s, pair, cache);
        return flip_difference(renderer.read_colour(frame.colour), renderer.read_colour(frame.true_colour));
    }
};

TEST_F(FlipFrameTest, MetricComparesThePictureWithTheReferences) {
    const Settings acne = test::texel_settings("hard", 256, 0), fine = test::texel_settings("hard", 4096, 4);
    const double bad = measured_flip(acne), good = measured_flip(fine);
    EXPECT_EQ(bad, flip_of_pictures(acne).mean);
    EXPECT_GT(bad, 0.05);
    EXPECT_LT(good, bad / 5);
    EXPECT_EQ(measured_flip(settings_with(acne, {"light.source=traced"})), 0) << "its shadows are the reference's";
}

TEST_F(FlipFrameTest, MetricIgnoresOverlaysPanesAndSmoothing) {
    Settings s = test::texel_settings("hard", 256, 0);
    const double plain = measured_flip(s);
    set_all(s, {"view.panes=two", "view.overlay=artefacts", "view.overlay_2=stored-depth"});
    request.smoothed = 4;
    EXPECT_EQ(measured_flip(s), plain);
}

TEST_F(FlipFrameTest, MetricIsMeasuredOnRequestAlone) {
    const Settings s = test::texel_settings("hard", 256, 0);
    const MeasuredError without = measure_error(renderer, scene, s, request, 0, reference_options(s), cache);
    EXPECT_TRUE(std::isnan(without.metrics.flip));
    EXPECT_GT(without.metrics.mae, 0);
    request.outputs = {.colour = true, .error = true};
    const FrameResult frame = render_with_reference(renderer, scene, s, request, cache);
    ASSERT_TRUE(frame.error);
    EXPECT_TRUE(std::isnan(frame.error->metrics.flip));
    const PassInfo* pass = frame.pass(Result::Flip);
    ASSERT_TRUE(pass);
    EXPECT_EQ(pass->state, PassState::Skipped) << pass->reason;
    EXPECT_EQ(frame.pass(Result::ReferenceLitPicture)->state, PassState::Skipped);
}

TEST_F(FlipFrameTest, OverlayAndLiveErrorShowTheMetric) {
    Settings s = test::texel_settings("hard", 256, 0);
    const Flip flip = flip_of_pictures(s);
    set_setting(s, "view.overlay", "flip-difference");
    request.outputs = {.colour = true, .overlay = true, .error = true};
    const FrameResult frame = render_with_reference(renderer, scene, s, request, cache);
    ASSERT_TRUE(frame.error);
    EXPECT_NEAR(frame.error->metrics.flip, flip.mean, 1e-7);
    EXPECT_EQ(frame.overlay_min, 0);
    EXPECT_EQ(frame.overlay_max, 1);
    const FloatImage values = renderer.read_float(frame.overlay, 4);
    int shown = 0;
    float off = 0;
    for (int y = 0; y < values.height; ++y)
        for (int x = 0; x < values.width; ++x) {
            if (!(values.at(x, y, 3) > 0)) continue;
            ++shown;
            off = std::max(off, std::abs(values.at(x, y) - flip.map.at(x, y)));
        }
    EXPECT_GT(shown, 20000);
    EXPECT_LT(off, 1e-6f);
}

TEST_F(FlipFrameTest, OverlayIsComputedAgainOnlyWhenAPictureChanges) {
    Settings s = test::texel_settings("hard", 256, 0);
    set_setting(s, "view.overlay", "flip-difference");
    request.outputs = {.colour = true, .error = true};
    const auto draw = [&] { return render_with_reference(renderer, scene, s, request, cache); };
    const FrameResult first = draw(), again = draw();
    EXPECT_EQ(again.pass(Result::Flip)->state, PassState::Cached) << again.pass(Result::Flip)->reason;
    EXPECT_EQ(again.error->metrics.flip, first.error->metrics.flip);
    s.bias.constant = 4;
    const FrameResult biased = draw();
    EXPECT_EQ(biased.pass(Result::Flip)->state, PassState::Drawn);
    EXPECT_LT(biased.error->metrics.flip, first.error->metrics.flip / 2);
}

}  // namespace
}  // namespace si
