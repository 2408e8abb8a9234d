// Tests of extremes and counts of depth images.
#include "renderer/frame/depth_histogram.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace si {
namespace {

DepthCurve curve_of(bool perspective, bool reversed) {
    return {.perspective = perspective, .near = 1, .far = 100, .convention = {true, reversed}};
}

/// Makes an image of depths at the given distances, and `empty` pixels of the far plane.
FloatImage image_of(const DepthCurve& curve, const std::vector<double>& metres, int empty) {
    FloatImage image{int(metres.size()) + empty, 1, 1, {}};
    for (const double z : metres) image.data.push_back(float(curve.depth(z)));
    image.data.insert(image.data.end(), std::size_t(empty), float(curve.convention.far_depth()));
    return image;
}

TEST(DepthHistogram, ExtremesExcludeTheBackground) {
    for (const bool perspective : {false, true})
        for (const bool reversed : {false, true}) {
            const DepthCurve curve = curve_of(perspective, reversed);
            const DepthStatistics s = depth_statistics(image_of(curve, {4, 2, 50.5, 3}, 5), curve);
            EXPECT_EQ(s.drawn, 4u);
            EXPECT_EQ(s.empty, 5u);
            EXPECT_NEAR(s.metres_min, 2, 1e-4);
            EXPECT_NEAR(s.metres_max, 50.5, 1e-2);
            EXPECT_NEAR(s.linear_min, 1.0 / 99, 1e-5);
            EXPECT_NEAR(s.linear_max, 0.5, 1e-4);
            EXPECT_NEAR(s.stored_min, curve.depth(reversed ? 50.5 : 2), 1e-6);
            EXPECT_NEAR(s.stored_max, curve.depth(reversed ? 2 : 50.5), 1e-6);
        }
}

TEST(DepthHistogram, EmptyMapHasNoExtremes) {
    const DepthCurve curve = curve_of(true, false);
    FloatImage image = image_of(curve, {}, 3);
    image.data[1] = std::numeric_limits<float>::quiet_NaN();
    const DepthStatistics s = depth_statistics(image, curve);
    EXPECT_EQ(s.drawn, 0u);
    EXPECT_EQ(s.empty, 3u);
    EXPECT_EQ(s.stored_min, 0);
    EXPECT_EQ(s.metres_max, 0);
}

TEST(DepthHistogram, EqualStepsOfDistanceFillLinearBinsEvenly) {
    // Ten pixels a tenth of the range apart: one a bin in linear depth; a perspective map crowds them at its far end.
    std::vector<double> metres;
    for (int i = 0; i < 10; ++i) metres.push_back(1 + 99 * (i + 0.5) / 10);
    for (const bool reversed : {false, true}) {
        const DepthCurve curve = curve_of(true, reversed);
        const FloatImage image = image_of(curve, metres, 7);
        const DepthHistogram linear = depth_histogram(image, curve, MapView::Linear, 10);
        EXPECT_EQ(linear.counts, std::vector<std::uint64_t>(10, 1));
        const DepthHistogram raw = depth_histogram(image, curve, MapView::Raw, 10);
        // depth(5.95 m) = 0.8403 and depth(15.85 m) = 0.9464: one in the ninth bin, nine in the tenth.
        std::vector<std::uint64_t> expected(10, 0);
        expected[reversed ? 1 : 8] = 1;
        expected[reversed ? 0 : 9] = 9;
        EXPECT_EQ(raw.counts, expected);
        std::vector<std::uint64_t> from_near(10, 0);
        from_near[8] = 1;
        from_near[9] = 9;
        EXPECT_EQ(depth_histogram(image, curve, MapView::Bands, 10).counts, from_near);
    }
}

TEST(DepthHistogram, RangeCountsValuesOutside) {
    const DepthCurve curve = curve_of(false, false);
    const FloatImage image = image_of(curve, {1 + 9.9, 1 + 19.8, 1 + 49.5, 1 + 89.1}, 1);  // 0.1 0.2 0.5 0.9
    const DepthHistogram h = depth_histogram(image, curve, MapView::Raw, 4, 0.15, 0.55);
    EXPECT_EQ(h.below, 1u);
    EXPECT_EQ(h.above, 1u);
    EXPECT_EQ(h.counts, (std::vector<std::uint64_t>{1, 0, 0, 1}));
    // The image's own extremes as the range: the largest value is in the last bin.
    const DepthStatistics s = depth_statistics(image, curve);
    const DepthHistogram fitted = depth_histogram(image, curve, MapView::Raw, 4, s.stored_min, s.stored_max);
    EXPECT_EQ(fitted.below + fitted.above, 0u);
    EXPECT_EQ(fitted.counts.front(), 2u);
    EXPECT_EQ(fitted.counts.back(), 1u);
    EXPECT_EQ(std::accumulate(fitted.counts.begin(), fitted.counts.end(), std::uint64_t{0}), s.drawn);
    // A single value.
    const DepthHistogram point = depth_histogram(image_of(curve, {50, 50}, 0), curve, MapView::Raw, 4, 0.5, 0.5);
    EXPECT_EQ(point.counts.size(), 4u);
}

}  // namespace
}  // namespace si
