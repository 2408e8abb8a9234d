// Tests of the search for the least bias, on made-up frames with a known answer.
#include "renderer/advise/least_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "renderer/base/workers.h"
#include "renderer/settings/biases.h"

namespace si {
namespace {

const Bias& row_of(std::string_view key) {
    return *std::ranges::find(biases(), key, &Bias::key);
}

/// Frame of tilted planes. Each shows acne below the bias that it needs, and loses shadow in proportion to its bias.
struct MadeUpFrame {
    double harder = 1;           ///< factor by which the surfaces need more than theory says
    double lost_per_texel = 30;  ///< pixels that each texel of bias loses
    int planes = 100;

    double need(int i) const { return harder * std::tan((0.02 + 0.95 * i / 99.0) * M_PI / 2); }
    static double equivalent_bias(const BiasSettings& b) { return b.constant + b.slope + b.normal + b.raster_slope; }

    BiasTrial shown(const BiasSettings& b) const {
        BiasTrial t;
        t.error.counted = 100'000;
        t.needs.pixels = 1000;
        std::size_t acne = 0;
        for (int i = 0; i < planes; ++i) acne += equivalent_bias(b) < need(i);
        const std::size_t lost = std::size_t(lost_per_texel * equivalent_bias(b));
        t.error.artefacts[std::size_t(Artefact::Acne)] = acne;
        t.error.artefacts[std::size_t(Artefact::PeterPanning)] = lost;
        t.error.mae = 1e-6 * double(acne + lost);
        t.needs.gap_p95_m = 0.01 * equivalent_bias(b);
        t.score = double(acne) + lost_per_texel * equivalent_bias(b);
        return t;
    }
    /// Returns the least score over a fine grid of one amount.
    double least_score() const {
        double least = 1e300;
        for (double bias = 0; bias < 100; bias += 0.001) {
            BiasSettings b{.constant = bias, .slope = 0, .normal = 0};
            least = std::min(least, shown(b).score);
        }
        return least;
    }
};

BiasSettings none() {
    return {.constant = 0, .slope = 0, .normal = 0};
}
std::vector<BiasStart> starts() {
    BiasSettings constant = none(), normal = none();
    constant.constant = 30;
    normal.normal = 20;
    return {{&row_of("constant"), constant}, {&row_of("normal-offset"), normal}};
}
FoundBias searched(const MadeUpFrame& frame, std::optional<double> max_gap_m = {}) {
    double progress = 0;
    return search_least_bias(
        frame.shown(none()), starts(), [&](const BiasSettings& b) { return frame.shown(b); }, max_gap_m,
        [&](double share, const std::string& step) {
            EXPECT_GE(share, progress);
            EXPECT_LE(share, 1);
            EXPECT_FALSE(step.empty());
            progress = share;
        });
}

TEST(LeastBias, ComesWithinTwoPercentOfTheLeastScore) {
    for (const double harder : {0.4, 0.97, 1.8})
        for (const double lost : {0.5, 3.0, 30.0}) {
            const MadeUpFrame frame{.harder = harder, .lost_per_texel = lost};
            SCOPED_TRACE(testing::Message() << harder << " " << lost);
            const FoundBias found = searched(frame);
            ASSERT_TRUE(found.best());
            EXPECT_EQ(found.best_of_rows().size(), 2u);
            EXPECT_LT(found.tried.size(), 40u);
            EXPECT_LE(found.best()->trial.score, 1.02 * frame.least_score() + 1);
        }
}

TEST(LeastBias, HasASecondResultWithoutAcne) {
    // Losing shadow costs more than acne does, so that the least score leaves some.
    const MadeUpFrame frame{.lost_per_texel = 30};
    const FoundBias found = searched(frame);
    ASSERT_TRUE(found.best_without_acne());
    EXPECT_GT(found.best()->trial.acne(), 10u);
    EXPECT_LE(found.best_without_acne()->trial.acne(), std::size_t(kMaxAcneShare * 100'000));
    EXPECT_NE(found.summary(true).find("least bias without acne"), std::string::npos);

    const FoundBias hopeless = searched({.harder = 1e5});
    EXPECT_TRUE(hopeless.best());
    EXPECT_FALSE(hopeless.best_without_acne());
    EXPECT_NE(hopeless.summary(true).find("no bias is without acne"), std::string::npos);
}

TEST(LeastBias, KeepsALimitOfTheGap) {
    const MadeUpFrame frame{.lost_per_texel = 0.1};
    const FoundBias free = searched(frame), bound = searched(frame, 0.05);
    EXPECT_GT(free.best()->trial.needs.gap_p95_m, 0.05);
    if (bound.best()) {
        EXPECT_LE(bound.best()->trial.needs.gap_p95_m, 0.05);
    }
    EXPECT_NE(bound.summary(false).find(bound.best() ? "gap of at most 50 mm" : "allow a wider gap"),
              std::string::npos);
}

TEST(LeastBias, FindsTheFewStrengthsWithinALimitOfTheGap) {
    const MadeUpFrame frame{.lost_per_texel = 0.1};
    const FoundBias bound = searched(frame, 0.01);
    ASSERT_TRUE(bound.best());
    EXPECT_LT(bound.best()->trial.score, 60) << "one texel of the constant: 52; no bias at all: 100";
}

TEST(LeastBias, TiesAreDecidedByErrorThenGap) {
    FoundBias found;
    const auto add = [&](const char* row, double score, double mae, double gap) {
        TriedBias t{&row_of(row), 1, none(), {}};
        t.trial.score = score;
        t.trial.error.mae = mae;
        t.trial.needs.gap_p95_m = gap;
        found.tried.push_back(t);
    };
    add("constant", 1000.0000000001, 0.02, 0.1);
    add("slope", 1000.2, 0.01, 0.3);
    add("adaptive", 1000.1, 0.01, 0.2);
    add("receiver-plane", 1020, 0.001, 0.001);
    EXPECT_EQ(found.best()->row->key, "adaptive");
    found.tried.clear();
    found.before.error.counted = 1000;
    add("constant", 0.01, 0.0001, 0.2);
    add("adaptive", 0.02, 0.0004, 0.01);
    EXPECT_EQ(found.best()->row->key, "adaptive") << "errors differ by less than half of one pixel in a thousand";
    add("slope", 0.02, 0.0010, 0.001);
    EXPECT_EQ(found.best()->row->key, "adaptive");
}

TEST(LeastBias, ABiasWithMoreWrongPixelsThanBeforeWinsOnlyIfAllHaveMore) {
    FoundBias found;
    found.before.error.artefacts[std::size_t(Artefact::Acne)] = 27;
    const auto add = [&](const char* row, double score, std::size_t wrong) {
        TriedBias t{&row_of(row), 1, none(), {}};
        t.trial.score = score;
        t.trial.error.artefacts[std::size_t(Artefact::PeterPanning)] = wrong;
        found.tried.push_back(t);
    };
    add("receiver-plane", 33, 28);
    EXPECT_EQ(found.best()->row->key, "receiver-plane");
    add("adaptive", 46, 27);
    add("constant", 50, 20);
    EXPECT_EQ(found.best()->row->key, "adaptive");
}

/// Searches made-up trials: the constant row has the score `score(strength)`, the normal offset `times` as much.
FoundBias searched_by_score(const std::function<double(double)>& score, double times,
                            std::optional<double> max_gap_m = {}) {
    BiasTrial before;
    before.needs.pixels = 1000;
    return search_least_bias(
        before, starts(),
        [&](const BiasSettings& b) {
            BiasTrial t = before;
            t.score = b.normal > 0 ? times * score(b.normal / 20) : score(b.constant / 30);
            return t;
        },
        max_gap_m);
}
std::vector<double> strengths_of(const FoundBias& found, std::string_view row) {
    std::vector<double> out;
    for (const TriedBias& t : found.tried)
        if (t.row->key == row) out.push_back(t.strength);
    return out;
}

TEST(LeastBias, StrengthsEndAfterTwoRisesOfTheScore) {
    const auto tried = [&](const std::function<double(double)>& score, double strength) {
        const FoundBias found = searched_by_score(score, 1);
        EXPECT_EQ(strengths_of(found, "constant")[0], 1);
        return std::ranges::count(strengths_of(found, "constant"), strength) > 0;
    };
    const auto from_one = [](double s) { return 100 + 10 * std::abs(std::log2(s + 1e-6)); };
    EXPECT_TRUE(tried(from_one, 0.25));
    EXPECT_FALSE(tried(from_one, 1 / 8.));
    const auto from_a_tenth = [](double s) { return 100 + 10 * std::abs(std::log2(10 * s + 1e-6)); };
    EXPECT_TRUE(tried(from_a_tenth, 1 / 16.));
    EXPECT_TRUE(tried(from_a_tenth, 1 / 32.));
    EXPECT_FALSE(tried(from_a_tenth, 1 / 64.));
    // Scores that stay equal are no rises: beyond its casters a bias loses no more.
    const auto plateau = [](double s) { return std::min(500.0, 3750 * s) + (s < 1 / 30. ? 2000 : 0); };
    EXPECT_TRUE(tried(plateau, 1 / 16.));
    // One rise may be chance.
    const auto beyond_a_hill = [&](double s) { return s == 0.5 ? 200 : from_a_tenth(s); };
    EXPECT_TRUE(tried(beyond_a_hill, 1 / 8.));
    EXPECT_NEAR(searched_by_score(beyond_a_hill, 1).best()->trial.score, 100, 2);
}

TEST(LeastBias, RowsOutOfReachGetNoFinerTrials) {
    const auto score = [](double s) { return 100 + 10 * std::abs(std::log2(3 * s + 1e-6)); };
    const auto finer = [&](double times, std::optional<double> max_gap_m = {}) {
        const std::vector<double> all = strengths_of(searched_by_score(score, times, max_gap_m), "normal-offset");
        return std::ranges::count_if(all, [](double s) { return s > 0 && std::exp2(std::round(std::log2(s))) != s; });
    };
    EXPECT_EQ(finer(1.4), 5);
    EXPECT_EQ(finer(1.8), 3) << "given up after three";
    EXPECT_EQ(finer(3), 0);
    EXPECT_EQ(finer(3, 1.0), 5) << "the bias with the least score may exceed the limit of the gap";
}

TEST(LeastBias, StopsWithWhatIsThere) {
    const MadeUpFrame frame;
    int trials = 0;
    const BiasMeter meter = [&](const BiasSettings& b) {
        if (++trials > 8) throw Cancelled();
        return frame.shown(b);
    };
    const FoundBias found = search_least_bias(frame.shown(none()), starts(), meter);
    EXPECT_TRUE(found.stopped);
    ASSERT_EQ(found.best_of_rows().size(), 1u);
    EXPECT_NE(found.summary(false).find("stopped"), std::string::npos);
    EXPECT_THROW(search_least_bias(frame.shown(none()), starts(), meter), Cancelled) << "nothing was tried";
}

TEST(LeastBias, NothingLitNeedsNoBias) {
    BiasTrial dark;
    const FoundBias found = search_least_bias(dark, starts(), [&](const BiasSettings&) { return dark; });
    EXPECT_FALSE(found.best());
    EXPECT_EQ(found.summary(false), "nothing in the picture is lit within the map: no bias is needed");
}

TEST(LeastBias, StrengthsScaleEveryAmount) {
    BiasSettings b = none();
    b.constant = 2;
    b.raster_slope = 3;
    b.raster_units = 4;
    const BiasSettings half = scale_bias(b, 0.5);
    EXPECT_EQ(half.constant, 1);
    EXPECT_EQ(half.raster_slope, 1.5);
    EXPECT_EQ(half.raster_units, 2);
    EXPECT_EQ(scale_bias(b, 1e12).constant, 1000) << "the limit of the setting";
    EXPECT_FALSE((BiasStart{&row_of("adaptive"), none()}.has_strength()));
    EXPECT_TRUE((BiasStart{&row_of("constant"), b}.has_strength()));
}

}  // namespace
}  // namespace si
