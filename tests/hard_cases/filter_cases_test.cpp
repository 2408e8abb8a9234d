// Tests hard cases 22 to 26 and 38: kernels that read averages of functions of depth, tables of sums, and blocker
// searches.
#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/measure/measured_error.h"
#include "renderer/settings/filters.h"
#include "renderer/view/lights/kernel_reach.h"
#include "tests/support/hard_view.h"
#include "tests/support/sets.h"
#include "tests/support/stability.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

/// Returns the errors outside the reach of the kernel and its blur.
ReferenceErrors errors(const DrawnCase& c, const Shot& shot) {
    const double reach =
        kernel_reach_in_light(c.settings, shot.light(), shot.frame.map_resolution).edge + c.settings.filter.blur;
    return compare_with_reference(shot, c.scene, reach + 2);
}

/// Returns the unlit share of the lit sheet of hard_slope(), away from its sides and from the bar's shadow.
double grey_share(const DrawnCase& c) {
    const Shot shot = draw_shot(c);
    const double reach =
        kernel_reach_in_light(c.settings, shot.light(), shot.frame.map_resolution).edge + c.settings.filter.blur;
    const ReferenceImage reference = trace_reference(RayReference(c.scene), shot, reach + 2);
    int grey = 0, sheet = 0;
    for (std::size_t i = 0; i < reference.states.size(); ++i) {
        if (reference.states[i] != ReferenceState::Lit ||
            glm::dot(reference.hits[i]->normal, shot.light().to_light) < 0.999)
            continue;
        const glm::dvec3 p = reference.hits[i]->position - glm::dvec3(0, 2, 0);
        if (std::max(std::abs(p.x), glm::length(glm::dvec2(p.y, p.z))) > 4.75) continue;
        ++sheet;
        grey += shot.visibility.data[i] < 1 - 1e-3f;
    }
    EXPECT_GT(sheet, 3000);
    return double(grey) / std::max(sheet, 1);
}

// For almost equal depths, single precision gives E(z^2) - E(z)^2 either sign.
TEST(HardCase22, VarianceIsNeverNegative) {
    const DrawnCase mended = hard_view("variance-cancels", true);
    const Shot shot = draw_shot(mended);
    expect_within_limit(22, grey_share(mended));
    const FloatImage& map = shot.maps.at(0);
    const int radius = mended.settings.filter.blur;
    int negative = 0, flat = 0;
    for (int y = radius; y < map.height - radius; y += 3)
        for (int x = radius; x < map.width - radius; x += 3) {
            float first = 0, second = 0;
            float least = 1, most = 0;
            for (int j = -radius; j <= radius; ++j)
                for (int i = -radius; i <= radius; ++i) {
                    const float z = map.at(x + i, y + j);
                    first += z;
                    second += z * z;
                    least = std::min(least, z);
                    most = std::max(most, z);
                }
            if (most == 1 || most - least > 1e-4f) continue;
            const auto n = float((2 * radius + 1) * (2 * radius + 1));
            ++flat;
            negative += second / n - (first / n) * (first / n) < 0;
        }
    EXPECT_GT(flat, 1000);
    expect_fault(22, double(negative) / std::max(flat, 1));
    EXPECT_GT(grey_share(hard_view("variance-cancels", false)), 1e-3)
        << "without a least variance the sheet must be speckled";
}

SI_TEST_IS(Later, HardCase23, NoExponentGivesNaN);
TEST(HardCase23, NoExponentGivesNaN) {
    int formats = 0;
    const float large = std::exp(88.f);
    formats += std::isinf(large * large) ? 1 : 0;  // 32 bits
    formats += large > 65504.f ? 1 : 0;            // 16 bits
    expect_fault(23, formats);
    for (const char* kernel : {"esm", "evsm2", "evsm4"})
        for (const char* format : {"32-bit", "16-bit"})
            for (const char* exponent : {"0.5", "40", "88"}) {
                SCOPED_TRACE(std::string(kernel) + " " + format + " " + exponent);
                const DrawnCase c = hard_view("exponents", true,
                                              {{"filter.kernel", kernel},
                                               {"filter.moment_format", format},
                                               {"filter.exponent", exponent},
                                               {"filter.negative_exponent", exponent}});
                const Shot shot = draw_shot(c);
                expect_within_limit(23, errors(c, shot).false_shadow);
                if (std::string(exponent) == "88") {
                    EXPECT_FALSE(shot.frame.notes.empty()) << "a clamped exponent must be reported";
                }
            }
}

SI_TEST_IS(Later, HardCase24, FixedMomentsKeepSixteenBitsLit);
TEST(HardCase24, FixedMomentsKeepSixteenBitsLit) {
    const auto grey = [](const char* kernel, bool fixed) {
        const DrawnCase c = hard_view("moment-steps", fixed, {{"filter.kernel", kernel}});
        const ReferenceErrors e = errors(c, draw_shot(c));
        EXPECT_GT(e.domain - e.shadow - e.boundary, 3000);
        return double(e.any_acne) / std::max(e.domain, 1);
    };
    for (const char* kernel : {"msm_hamburger", "msm_hausdorff"}) {
        expect_within_limit(24, grey(kernel, true));
        expect_fault(24, grey(kernel, false));
    }
}

SI_TEST_IS(Later, HardCase25, SumsOfIntegersEqualABlur);
TEST(HardCase25, SumsOfIntegersEqualABlur) {
    const Shot blurred = draw_shot(hard_view("summed-areas", true, {"filter.kernel=vsm", "filter.blur=2"}));
    const auto off = [&](bool fixed) {
        const Shot summed = draw_shot(hard_view("summed-areas", fixed));
        double total = 0;
        for (std::size_t i = 0; i < summed.visibility.data.size(); ++i)
            total += std::abs(double(summed.visibility.data[i]) - blurred.visibility.data[i]);
        return total / double(summed.visibility.data.size());
    };
    EXPECT_GT(shadow_share(blurred), 0.01);
    expect_within_limit(25, off(true));
    expect_fault(25, off(false));
}

SI_TEST_IS(Later, HardCase26, EmptyAndFullyCoveredWindowsGiveLightAndShadow);
TEST(HardCase26, EmptyAndFullyCoveredWindowsGiveLightAndShadow) {
    for (const char* kernel : {"pcss", "dpcf"})
        for (const char* size : {"0", "1"}) {
            SCOPED_TRACE(std::string(kernel) + " " + size);
            const DrawnCase c = hard_view("no-blockers", true, {{"filter.kernel", kernel}, {"light.size", size}});
            const Shot shot = draw_shot(c);
            const double reach = kernel_reach_in_light(c.settings, shot.light(), shot.frame.map_resolution).edge + 2;
            const ReferenceImage reference = trace_reference(RayReference(c.scene), shot, reach);
            double worst = 0;
            int clear = 0, covered = 0;
            for (std::size_t i = 0; i < reference.states.size(); ++i) {
                if (reference.states[i] == ReferenceState::Lit) {
                    ++clear;
                    worst = std::max(worst, std::abs(1.0 - shot.visibility.data[i]));
                }
                if (reference.states[i] == ReferenceState::Shadow) {
                    ++covered;
                    worst = std::max(worst, double(shot.visibility.data[i]));
                }
            }
            expect_within_limit(26, worst);
            expect_fault(26, clear);
            EXPECT_GT(covered, 100);
        }
}

SI_TEST_IS(Later, HardCase38, WarpedDepthsDoNotBleed);
TEST(HardCase38, WarpedDepthsDoNotBleed) {
    const auto bleeding = [](bool fixed) {
        const DrawnCase c = hard_view("light-bleeding", fixed);
        ReferenceCache cache;
        const MeasuredError e =
            measure_error(hard_renderer(), c.scene, c.settings, {.width = 160, .height = 120}, 0, {}, cache);
        EXPECT_EQ(e.metrics.leak, 0);
        return e.metrics.light_bleeding;
    };
    expect_within_limit(38, bleeding(true));
    expect_fault(38, bleeding(false));
}

}  // namespace
}  // namespace si::test
