// Tests of FLIP between the picture and the picture with the reference's shadows.
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
}

}  // namespace
}  // namespace si
