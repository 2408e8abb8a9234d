// Tests of the grid of an area light that samples more beside edges: compared with plain runs and with known shares.
#include "renderer/reference/seen_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/traced.h"

namespace si {
namespace {

constexpr double kUnit = 1.0 / 65536;
using StateAt = std::function<Seen(double x, double y)>;  // x, y in [0, 1) on the light's square

/// Light whose states are known: starts with 64 samples and refines up to `end` of them.
struct Looked {
    Emitter emitter = test::sun({0.3, 1, 0.2}, 1);
    LightSamples samples;
    SeenLight light;
    std::size_t asked = 0;

    Looked(const StateAt& state, std::uint32_t end, std::uint32_t plain, std::uint64_t pixel = 5)
        : samples(emitter, {1, 2, 3}, pixel) {
        const auto at = [&](std::uint32_t k) {
            const LightCell cell = samples.cell(k);
            return state((cell.x + 0.5) * kUnit, (cell.y + 0.5) * kUnit);
        };
        std::vector<Seen> first;
        for (std::uint32_t k = 0; k < std::min(64u, end); ++k) first.push_back(at(k));
        light.start(samples, first);
        while (light.fineness() < end) {
            const std::span<const std::uint32_t> points =
                light.halve(samples, std::min(end, 2 * light.fineness()), light.fineness() < plain);
            asked += points.size();
            std::vector<Seen> seen;
            for (const std::uint32_t k : points) seen.push_back(at(k));
            light.set_wanted(seen);
        }
    }
};

Seen lit(bool is) {
    return is ? Seen::Lit : Seen::Dark;
}

/// Visibility and error of a plain run of 2^digits samples, from each sample in turn.
Estimate plain(const LightSamples& samples, const StateAt& state, int digits) {
    const int across = (digits + 1) / 2;
    std::vector<std::array<int, 2>> groups(std::size_t{1} << (digits - 2));
    for (std::uint32_t k = 0; k < 1u << digits; ++k) {
        const LightCell cell = samples.cell(k);
        const Seen seen = state((cell.x + 0.5) * kUnit, (cell.y + 0.5) * kUnit);
        if (seen == Seen::Below) continue;
        auto& group = groups[std::size_t(cell.y >> (17 - digits / 2) << (across - 1) | cell.x >> (17 - across))];
        group[0] += seen == Seen::Lit;
        ++group[1];
    }
    double all_lit = 0, all = 0, sum = 0, known = 0;
    for (const auto& [lit_here, above] : groups) {
        all_lit += lit_here;
        all += above;
        if (above < 2) continue;
        sum += double(lit_here) * (above - lit_here) / (above - 1);
        known += above;
    }
    return {all_lit / all, std::sqrt(sum / (known * all)), std::size_t{1} << digits, 0};
}

TEST(SeenLight, EqualsAPlainRunWhereAllCellsAreSampled) {
    const StateAt disk = [](double x, double y) {
        if (y > 0.83 - 0.1 * x) return Seen::Below;
        return lit(std::hypot(x - 0.4, y - 0.3) > 0.27);
    };
    for (const int digits : {6, 7, 8, 10, 11, 13, 14}) {
        const Looked looked(disk, 1u << digits, 1u << 20);
        const Estimate found = looked.light.estimate(0), wanted = plain(looked.samples, disk, digits);
        EXPECT_NEAR(found.visibility, wanted.visibility, 1e-12) << digits;
        EXPECT_NEAR(found.error, wanted.error, 1e-12) << digits;
        EXPECT_EQ(found.samples, std::size_t{1} << digits);
        EXPECT_EQ(looked.asked, (std::size_t{1} << digits) - 64) << "no sample twice";
    }
}

TEST(SeenLight, SamplesAnEdgeAsFinelyAsAPlainRun) {
    for (const double angle_deg : {0.0, 17.0, 45.0, 90.0, 133.0}) {
        const double c = std::cos(glm::radians(angle_deg)), s = std::sin(glm::radians(angle_deg));
        for (const double offset : {-0.31, 0.0, 0.2}) {
            const StateAt edge = [=](double x, double y) { return lit(c * (x - 0.5) + s * (y - 0.5) < offset); };
            for (const int digits : {10, 12, 14}) {
                const Looked looked(edge, 1u << digits, 256);
                const Estimate found = looked.light.estimate(0), wanted = plain(looked.samples, edge, digits);
                EXPECT_NEAR(found.visibility, wanted.visibility, 0.5 / (1 << digits)) << angle_deg << " " << offset;
                EXPECT_NEAR(found.error, wanted.error, 0.1 * wanted.error) << angle_deg << " " << offset;
                // Each halving samples three or four cells beside the edge, which is at most 1.4 sides long.
                EXPECT_LT(found.samples, 256 + 20 * std::size_t(std::sqrt(1 << digits))) << angle_deg << " " << offset;
            }
        }
    }
}

TEST(SeenLight, SamplesAllCellsWhereShadowsAreNarrow) {
    for (const double width : {0.15, 0.3}) {
        // Eight rods, each narrower than a cell of the grid of 16 by 16.
        const StateAt rods = [=](double x, double y) {
            const double across = 8 * (0.8 * x + 0.6 * y);
            return lit(across - std::floor(across) > width);
        };
        double ours = 0, all = 0;
        for (const std::uint64_t pixel : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
            const Looked looked(rods, 1024, 256, pixel);
            ours += looked.light.estimate(0).visibility / 8;
            all += plain(looked.samples, rods, 10).visibility / 8;
        }
        EXPECT_NEAR(ours, all, 0.002) << width;
    }
}

TEST(SeenLight, OneRodNarrowerThanCellsKeepsItsShare) {
    for (const double width : {0.2, 0.4}) {
        double ours = 0, all = 0;
        constexpr int kRods = 400;
        for (int n = 0; n < kRods; ++n) {
            const double angle = 0.7 * n, place = 0.3 * std::sin(1.3 * n), half = 0.5 * width / 16;
            const StateAt rod = [=](double x, double y) {
                return lit(std::abs(std::cos(angle) * (x - 0.5) + std::sin(angle) * (y - 0.5) - place) > half);
            };
            const Looked looked(rod, 1024, 256, std::uint64_t(n));
            ours += looked.light.estimate(0).visibility / kRods;
            all += plain(looked.samples, rod, 10).visibility / kRods;
        }
        EXPECT_NEAR(ours, all, 0.0008) << width;
    }
}

TEST(SeenLight, ErrorOfAnyNumberOfSamplesIsThatOfTheSamples) {
    const StateAt edge = [](double x, double y) { return lit(0.8 * x + 0.6 * y < 0.6); };
    for (const int digits : {4, 6, 8}) {
        const double exact = Looked(edge, 1u << digits, 1u << 20).light.estimate(0).error;
        for (const std::uint32_t more : {1u, 2u}) {
            double squares = 0;
            for (std::uint64_t pixel = 0; pixel < 64; ++pixel)
                squares += std::pow(Looked(edge, (1u << digits) + more, 1u << 20, pixel).light.estimate(0).error, 2);
            EXPECT_GT(std::sqrt(squares / 64), 0.7 * exact) << digits << " " << more;
        }
    }
}

TEST(SeenLight, CellsWithoutASampleTakeTheOtherHalfs) {
    const StateAt left_lit = [](double x, double) { return lit(x < 0.5); };
    for (const std::uint32_t end : {1u, 2u, 3u, 5u, 25u, 49u, 100u, 300u, 1000u, 5000u}) {
        const Looked looked(left_lit, end, 1u << 20);
        EXPECT_EQ(looked.light.fineness(), end);
        EXPECT_EQ(looked.light.estimate(0).samples, end);
        // From two samples on each half of the light has its own.
        EXPECT_NEAR(looked.light.estimate(0).visibility, 0.5, end == 1 ? 0.5 : 1e-12) << end;
        EXPECT_EQ(std::isnan(looked.light.estimate(0).error), end < 4) << end;
    }
}

TEST(SeenLight, HasTheHardShareBelowTheHorizon) {
    const Looked below([](double, double) { return Seen::Below; }, 256, 0);
    EXPECT_EQ(below.light.estimate(0).visibility, 0);
    EXPECT_EQ(below.light.estimate(1).visibility, 1);
    EXPECT_EQ(below.asked, 0u) << "all cells agree";
}

}  // namespace
}  // namespace si
