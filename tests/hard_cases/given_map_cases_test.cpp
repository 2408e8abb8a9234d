// Tests hard cases 42 to 46: maps of an engine, whose images are rays that the program computes in double.
#include <cmath>

#include "renderer/bundle/builtin_bundles.h"
#include "renderer/bundle/given_maps.h"
#include "renderer/measure/measured_error.h"
#include "tests/support/hard_view.h"
#include "tests/support/stability.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

ErrorMetrics given_metrics(const DrawnCase& c) {
    ReferenceCache cache;
    return measure_error(hard_renderer(), c.scene, c.settings, {.width = 320, .height = 240}, 0, {}, cache).metrics;
}

/// Returns the share of pixels that are wrong and lie at no edge of a shadow.
double wrong_inside(const ErrorMetrics& m) {
    const double share = m.false_shadow + m.false_light - m.boundary_false_shadow - m.boundary_false_light;
    return share < 1e-12 ? 0 : share;  // a sum of equal parts rounds
}

/// Returns the largest difference between a given map and the map that is drawn of the same scene by the same matrix,
/// in depth-buffer units, away from edges, and the number of texels that were compared.
std::pair<double, int> difference_from_drawn(const DrawnCase& c) {
    const auto given = given_maps(c.settings.map.bundle);
    const ImportedMaps& maps = *given->lights.at(0);
    FrameRequest request{.width = 64, .height = 48};
    request.outputs.shadow_map = true;
    request.imported = {drawn_maps(*maps.views, maps.size())};
    Settings settings = c.settings;
    settings.map.format = MapFormat::D32F;
    const FrameResult frame = hard_renderer().render(c.scene, settings, request);
    const FloatImage drawn = hard_renderer().read_shadow_map(frame, 0, 0);
    const FloatImage& image = maps.images.at(0);
    EXPECT_EQ(drawn.width, image.width);
    EXPECT_EQ(drawn.height, image.height);
    double most = 0;
    int compared = 0;
    for (int y = 1; y + 1 < image.height; ++y)
        for (int x = 1; x + 1 < image.width; ++x) {
            const auto bend = [&](const FloatImage& map, int dx, int dy) {
                return std::abs(map.at(x - dx, y - dy) + map.at(x + dx, y + dy) - 2 * map.at(x, y));
            };
            // On planes depth is linear by texel.
            if (std::max(bend(image, 1, 0), bend(image, 0, 1)) > 1e-4) continue;
            if (std::max(bend(drawn, 1, 0), bend(drawn, 0, 1)) > 1e-4) continue;
            ++compared;
            most = std::max(most, double(std::abs(drawn.at(x, y) - image.at(x, y))));
        }
    return {most, compared};
}

void expect_no_acne(int number, std::string_view key) {
    expect_within_limit(number, given_metrics(hard_view(key, true)).acne);
    expect_fault(number, given_metrics(hard_view(key, false)).acne);
}

SI_TEST_IS(Later, HardCase42, StripsNeedTheBiasOfTheirLongSide);
TEST(HardCase42, StripsNeedTheBiasOfTheirLongSide) {
    expect_no_acne(42, "given-strip");
    const auto maps = given_maps("builtin:strip");
    EXPECT_EQ(4 * maps->lights.at(0)->size().width, maps->lights.at(0)->size().height);
    const auto [most, compared] = difference_from_drawn(hard_view("given-strip", true));
    EXPECT_GT(compared, 30000);
    EXPECT_LT(most, 1e-5);
}

SI_TEST_IS(Later, HardCase43, WarpedMapsNeedABiasByRow);
TEST(HardCase43, WarpedMapsNeedABiasByRow) {
    expect_no_acne(43, "given-warped");
    EXPECT_TRUE(given_maps("builtin:warped")->lights.at(0)->views->views.at(0).warped());
    const auto [most, compared] = difference_from_drawn(hard_view("given-warped", true));
    EXPECT_GT(compared, 30000);
    EXPECT_LT(most, 1e-5);
}

SI_TEST_IS(Later, HardCase44, ReversedDepthNeedsItsOwnMatrix);
TEST(HardCase44, ReversedDepthNeedsItsOwnMatrix) {
    const ErrorMetrics fixed = given_metrics(hard_view("given-reversed", true));
    expect_within_limit(44, wrong_inside(fixed));
    expect_fault(44, given_metrics(hard_view("given-reversed", false)).false_shadow);
    const auto [most, compared] = difference_from_drawn(hard_view("given-reversed", true));
    EXPECT_GT(compared, 30000);
    EXPECT_LT(most, 1e-6);
}

SI_TEST_IS(Later, HardCase45, SixteenBitsNeedTheirStep);
TEST(HardCase45, SixteenBitsNeedTheirStep) {
    expect_no_acne(45, "given-16-bits");
    const auto [most, compared] = difference_from_drawn(hard_view("given-16-bits", true));
    EXPECT_GT(compared, 30000);
    EXPECT_LT(most, 0.6 / 65535);
    EXPECT_GT(most, 0.4 / 65535) << "the values are not rounded";
}

SI_TEST_IS(Later, HardCase46, MatricesRelativeToTheCameraAreExact);
TEST(HardCase46, MatricesRelativeToTheCameraAreExact) {
    const ErrorMetrics fixed = given_metrics(hard_view("given-far-away", true));
    expect_within_limit(46, wrong_inside(fixed));
    const ErrorMetrics broken = given_metrics(hard_view("given-far-away", false));
    expect_fault(46, wrong_inside(broken));
    const auto [most, compared] = difference_from_drawn(hard_view("given-far-away", true));
    EXPECT_GT(compared, 30000);
    EXPECT_LT(most, 1e-5);
}

}  // namespace
}  // namespace si::test
