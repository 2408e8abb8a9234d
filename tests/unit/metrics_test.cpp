// Tests of error metrics over pictures made by hand, and of their distances.
#include "renderer/reference/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "renderer/reference/distance_transform.h"
#include "renderer/scenes/shapes.h"
#include "tests/support/traced.h"

namespace si {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Makes a reference from rows of characters: '.' lit, '#' dark, '+' half lit, ' ' background, 'o' turned away.
Reference reference_of(const std::vector<std::string>& rows) {
    Reference t;
    t.width = int(rows[0].size());
    t.height = int(rows.size());
    for (const std::string& row : rows)
        for (const char c : row) {
            t.state.push_back(c == ' '   ? PixelState::Background
                              : c == 'o' ? PixelState::FacesAway
                                         : PixelState::Counted);
            ++t.pixels[std::size_t(t.state.back())];
            t.visibility.data.push_back(c == '#' || c == 'o' ? 0.f : c == '+' ? 0.5f : 1.f);
            t.nearest_m.data.push_back(c == '#' ? 1.f : kNaN);
        }
    t.visibility.width = t.width;
    t.visibility.height = t.height;
    return t;
}

/// Makes a frame's visibility from the same characters; every wrong pixel has the cause.
std::vector<ClassifiedPixel> classified_of(const std::vector<std::string>& rows, const Reference& reference,
                                           Artefact cause = Artefact::EdgeAliasing) {
    const Reference drawn = reference_of(rows);
    std::vector<ClassifiedPixel> out(drawn.state.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (i >= reference.state.size() || reference.state[i] != PixelState::Counted) continue;
        const float v = drawn.visibility.data[i];
        out[i] = {Artefact::None, compared_bits(v, reference_pixel(reference, i), false), v};
        if (out[i].has(ClassifiedPixel::kFalseShadow) || out[i].has(ClassifiedPixel::kFalseLight))
            out[i].artefact = cause;
    }
    return out;
}

TEST(DistanceTransform, IsTheDistanceToTheNearestPixel) {
    Random random(4);
    for (const auto& [w, h] : {std::pair{1, 1}, {7, 1}, {1, 9}, {23, 17}}) {
        std::vector<std::uint8_t> set(std::size_t(w * h));
        for (auto& s : set) s = random.in(0, 1) < 0.1;
        const std::vector<float> distance = distance_to(set, w, h);
        const NearestSetPixel nearest(set, w, h);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                double least = INFINITY;
                for (int v = 0; v < h; ++v)
                    for (int u = 0; u < w; ++u)
                        if (set[std::size_t(v * w + u)]) least = std::min(least, std::hypot(u - x, v - y));
                EXPECT_EQ(distance[std::size_t(y * w + x)], float(least)) << x << ',' << y;
                EXPECT_EQ(nearest.distance(std::size_t(y * w + x)), float(least)) << x << ',' << y;
            }
    }
}

TEST(Metrics, AreZeroForEqualPictures) {
    const std::vector<std::string> rows = {"..##", "..##", "o.. "};
    const Reference reference = reference_of(rows);
    const ErrorMetrics m = error_metrics(classified_of(rows, reference), reference);
    EXPECT_EQ(m.counted, 10u);
    EXPECT_EQ(m.pixels[std::size_t(PixelState::Background)], 1u);
    EXPECT_EQ(m.pixels[std::size_t(PixelState::FacesAway)], 1u);
    for (const double v :
         {m.false_shadow, m.false_light, m.acne, m.leak, m.any_acne, m.visible_acne, m.any_leak, m.mae, m.rmse,
          m.signed_mean, m.outside_map, m.boundary_px_mean, m.boundary_px_p95, m.boundary_px_max})
        EXPECT_EQ(v, 0);
    EXPECT_EQ(m.iou, 1);
    EXPECT_EQ(m.artefacts[0], 12u);
}

TEST(Metrics, AreSumsOverTheirCauses) {
    // One false shadow and one false light of each cause that can be either.
    const Reference reference = reference_of({".......................#######################"});
    std::vector<ClassifiedPixel> classified =
        classified_of({"###############........########..............."}, reference);
    for (std::size_t a = 1; a < kArtefacts; ++a) classified[a - 1].artefact = classified[30 + a].artefact = Artefact(a);
    classified[std::size_t(Artefact::PeterPanningRaster) - 1].artefact = Artefact::Acne;
    classified[std::size_t(Artefact::LightBleeding) - 1].artefact = Artefact::Acne;
    classified[std::size_t(Artefact::Contact) + 30].artefact = Artefact::Leak;
    const ErrorMetrics m = error_metrics(classified, reference);
    EXPECT_DOUBLE_EQ(m.false_shadow * 46, 15);
    EXPECT_DOUBLE_EQ(m.false_light * 46, 15);
    std::size_t wrong = 0;
    for (std::size_t a = 1; a < kArtefacts; ++a) wrong += m.artefacts[a];
    EXPECT_EQ(wrong, 30u);
    const double all = m.acne + m.leak + m.light_bleeding + m.bias_false_light + m.lost_false_light +
                       m.offset_false_shadow + m.contact_false_shadow + m.boundary_false_shadow +
                       m.boundary_false_light + m.outside_false_shadow + m.outside_false_light;
    EXPECT_NEAR(all, m.false_shadow + m.false_light, 1e-12);
    EXPECT_DOUBLE_EQ(m.acne * 46, double(m.artefacts[std::size_t(Artefact::Acne)]));
    EXPECT_DOUBLE_EQ(m.light_bleeding * 46, 1);
    EXPECT_DOUBLE_EQ(m.leak * 46, double(m.artefacts[std::size_t(Artefact::Leak)]));
    EXPECT_DOUBLE_EQ(m.bias_false_light * 46, double(m.artefacts[std::size_t(Artefact::PeterPanning)] +
                                                     m.artefacts[std::size_t(Artefact::PeterPanningOffset)] +
                                                     m.artefacts[std::size_t(Artefact::PeterPanningRaster)]));
}

TEST(Metrics, CountNoErrorWithinTheNoiseOfTheReference) {
    Reference reference = reference_of({"++++++"});
    reference.point_visibility = reference.visibility;
    reference.visibility.data = {0.55f, 0.55f, 0.55f, 0.55f, 0.45f, 1.f};
    reference.standard_error = reference.visibility;
    reference.standard_error.data = {0.05f, 0.01f, 0.f, kNaN, 0.05f, 0.f};
    std::vector<ClassifiedPixel> classified(6);
    const float v[] = {0.45f, 0.45f, 0.45f, 0.f, 0.55f, 0.9f};
    for (std::size_t i = 0; i < 6; ++i)
        classified[i] = {Artefact::None, compared_bits(v[i], reference_pixel(reference, i), false), v[i]};
    using J = ClassifiedPixel;
    EXPECT_EQ(classified[0].bits, J::kCounts | J::kWithinNoise);
    EXPECT_EQ(classified[1].bits, J::kCounts | J::kFalseShadow) << "0.1 apart, noise 0.01";
    EXPECT_EQ(classified[2].bits, J::kCounts | J::kFalseShadow);
    EXPECT_EQ(classified[3].bits, J::kCounts | J::kWithinNoise) << "unknown noise decides nothing";
    EXPECT_EQ(classified[4].bits, J::kCounts | J::kWithinNoise);
    EXPECT_EQ(classified[5].bits, J::kCounts | J::kFaint);
    const ErrorMetrics m = error_metrics(classified, reference);
    EXPECT_DOUBLE_EQ(m.within_noise, 0.5);
    EXPECT_DOUBLE_EQ(m.false_shadow, 2.0 / 6);
    EXPECT_EQ(m.false_light, 0);
    EXPECT_DOUBLE_EQ(m.signed_mean, m.mae == 0 ? 1 : m.signed_mean);
    EXPECT_NEAR(m.mae, (0.1 * 3 + 0.55 + 0.1 + 0.1) / 6, 1e-6);
}

TEST(Metrics, CountErrorsThatAreSeen) {
    const Reference reference = reference_of({"....####"});
    std::vector<ClassifiedPixel> classified(8);
    const float v[] = {1.f, 0.985f, 0.975f, 0.2f, 0.f, 0.01f, 0.03f, 0.9f};
    for (std::size_t i = 0; i < 8; ++i) {
        classified[i] = {Artefact::None, compared_bits(v[i], reference_pixel(reference, i), false), v[i]};
        if (i == 1 || i == 2) classified[i].bits |= ClassifiedPixel::kAnyAcne;
        classified[i].any_leak = i == 6;
    }
    const ErrorMetrics m = error_metrics(classified, reference);
    EXPECT_DOUBLE_EQ(m.any_acne, 2.0 / 8);
    EXPECT_DOUBLE_EQ(m.visible_acne, 1.0 / 8) << "0.985 is not seen, and 0.2 is not acne";
    EXPECT_DOUBLE_EQ(m.any_leak, 1.0 / 8);
}

TEST(Metrics, MeasureContourDistance) {
    const std::vector<std::string> rows(8, "....########");
    const std::vector<std::string> moved(8, "......######");
    const ErrorMetrics m = error_metrics(classified_of(moved, reference_of(rows)), reference_of(rows));
    EXPECT_DOUBLE_EQ(m.boundary_px_mean, 1.5) << "one contour pixel of each lies 1 px off, the other 2";
    EXPECT_EQ(m.boundary_px_max, 2);
    EXPECT_EQ(m.boundary_px_p95, 2);
    const ErrorMetrics none = error_metrics(
        classified_of(std::vector<std::string>(8, "............"), reference_of(rows)), reference_of(rows));
    EXPECT_TRUE(std::isnan(none.boundary_px_mean));
    // Every fourth pixel of a picture: contour distances are four times as large.
    Reference coarse = reference_of(rows);
    coarse.step = 4;
    const ErrorMetrics far = error_metrics(classified_of(moved, coarse), coarse);
    EXPECT_DOUBLE_EQ(far.boundary_px_mean, 6);
    EXPECT_EQ(far.boundary_px_max, 8);
    EXPECT_EQ(far.boundary_px_p95, 8);
    // Borders between two surfaces of the picture are no contours.
    Receivers receivers{.width = 12, .height = 8, .pixels = BigArray<Receiver>(96)};
    for (std::size_t i = 0; i < 96; ++i) {
        receivers.pixels[i].same_surface_right = i % 12 != 3;
        receivers.pixels[i].same_surface_below = true;
    }
    EXPECT_TRUE(std::isnan(
        error_metrics(classified_of(moved, reference_of(rows)), reference_of(rows), &receivers).boundary_px_mean));
    EXPECT_THROW(error_metrics({}, reference_of(rows)), Error);
}

TEST(MetricRows, DefineEachNumberOnce) {
    std::set<std::string_view> keys, labels;
    for (const Metric& m : metrics()) {
        EXPECT_TRUE(keys.insert(m.key).second) << m.key;
        EXPECT_TRUE(labels.insert(m.label).second) << m.label;
        EXPECT_FALSE(m.formula.empty()) << m.key;
        EXPECT_TRUE(m.help.ends_with(".")) << m.key;
        EXPECT_EQ(find_metric(m.key), &m);
        EXPECT_EQ(m.part_of.empty(), m.part.empty()) << m.key;
        EXPECT_TRUE(m.part_of.empty() || find_metric(m.part_of)) << m.key;
        EXPECT_TRUE(m.member || m.causes) << m.key << " holds nothing";
    }
    EXPECT_EQ(metrics().front().key, "mae") << "what searches bound unless they are told";
    EXPECT_EQ(find_metric("prettiness"), nullptr);
}

TEST(MetricRows, CountEveryWrongPixelOnce) {
    // Each cause has 2^k pixels on each possible side: sums identify the counted causes.
    Reference reference;
    reference.state.assign(1 << 16, PixelState::Counted);
    reference.pixels[0] = reference.state.size();
    const double n = double(reference.state.size());
    using A = Artefact;
    const A dark[] = {A::Acne,   A::EdgeAliasing, A::OutsideMap, A::OffsetShadow,
                      A::Filter, A::Undersampled, A::Penumbra};
    const A bright[] = {A::PeterPanning,       A::Leak,         A::EdgeAliasing, A::OutsideMap, A::LostCaster,
                        A::PeterPanningOffset, A::Undersampled, A::Penumbra};
    PixelSums sums;
    double all_dark = 0, all_bright = 0, weight = 1;
    for (const A a : dark) {
        all_dark += sums.dark[std::size_t(a)] = weight;
        weight *= 2;
    }
    for (const A a : bright) {
        all_bright += sums.bright[std::size_t(a)] = weight;
        weight *= 2;
    }
    const ErrorMetrics m = metrics_of(sums, reference);
    EXPECT_EQ(m.false_shadow * n, all_dark);
    EXPECT_EQ(m.false_light * n, all_bright);
    for (const char* sum : {"false_shadow", "false_light"}) {
        double parts = 0;
        for (const Metric& row : metrics())
            if (row.part_of == sum) parts += row.value(m);
        EXPECT_EQ(parts, find_metric(sum)->value(m)) << sum;
    }
    EXPECT_EQ(m.acne * n, 1);
    EXPECT_EQ(m.offset_false_shadow * n, 8);
    EXPECT_EQ(m.outside_false_shadow * n, 4);
    EXPECT_EQ(m.boundary_false_shadow * n, 2 + 16 + 32 + 64);
    EXPECT_EQ(m.bias_false_light * n, 128 * (1 + 32));
    EXPECT_EQ(m.leak * n, 128 * 2);
    EXPECT_EQ(m.boundary_false_light * n, 128 * (4 + 64 + 128));
    EXPECT_EQ(m.outside_false_light * n, 128 * 8);
    EXPECT_EQ(m.lost_false_light * n, 128 * 16);
    EXPECT_EQ(find_metric("artefacts.undersampled")->value(m), 32 + 128 * 64);
    EXPECT_EQ(find_metric("artefacts.filter")->value(m), 16);
    EXPECT_EQ(double(m.artefacts[0]), n - all_dark - all_bright);
}

TEST(MetricRows, OrderTwoValues) {
    EXPECT_EQ(distance_from_best(find_metric("mae")->better, 0.25), 0.25);
    EXPECT_EQ(distance_from_best(find_metric("signed_mean")->better, -0.25), 0.25);
    EXPECT_EQ(distance_from_best(find_metric("iou")->better, 0.75), 0.25);
    EXPECT_TRUE(std::isnan(distance_from_best(find_metric("outside_map")->better, 0.25))) << "a fact, no quality";
}

}  // namespace
}  // namespace si
