// Tests of the searches for the minimum bias and the best setting, on made-up frames with a known answer.
#include "renderer/advise/tuner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/settings/depth_compare.h"
#include "renderer/settings/filters.h"

namespace si {
namespace {

/// Frame of tilted planes: the bias that each needs, and the equivalent bias of settings, in texels.
struct MadeUpFrame {
    double harder = 1;          ///< factor by which the surfaces need more than theory says
    double lost_by_normal = 0;  ///< pixels lost per texel of normal offset
    double kappa = 1;

    static double theta(int i) { return (0.02 + 0.95 * i / 99.0) * M_PI / 2; }
    double need(int i) const { return kappa * std::tan(theta(i)) + 0.01; }
    static double equivalent_bias(const BiasSettings& b, int i) {
        return std::max(b.constant, b.slope * (1 - std::cos(theta(i)))) + b.normal / std::cos(theta(i));
    }
    double worst(auto&& amount) const {
        double most = 0;
        for (int i = 0; i < 100; ++i) most = std::max(most, amount(i));
        return most;
    }

    BiasTrial shown(const BiasSettings& b) const {
        BiasTrial t;
        t.error.counted = 1000;
        int acne = 0;
        double gap = 0;
        for (int i = 0; i < 100; ++i) {
            acne += equivalent_bias(b, i) < harder * need(i);
            gap = std::max(gap, equivalent_bias(b, i) * std::sin(theta(i)));
        }
        t.needs.faint_acne = std::size_t(acne);
        t.error.artefacts[std::size_t(Artefact::PeterPanningOffset)] = std::size_t(b.normal * lost_by_normal);
        t.needs.pixels = 100;
        t.needs.gap_p95_m = gap;
        t.needs.gap_median_m = gap / 2;
        BiasSettings one;
        one.unit = BiasUnit::Texels;
        one.constant = worst([&](int i) { return need(i); });
        one.slope = one.normal = 0;
        t.needs.least[std::size_t(BiasFamily::Constant)] = one;
        one.constant = 0.3;
        one.slope = worst([&](int i) { return need(i) <= 0.3 ? 0 : need(i) / (1 - std::cos(theta(i))); });
        t.needs.least[std::size_t(BiasFamily::Slope)] = one;
        one.constant = 0.01;
        one.slope = 0;
        one.normal = worst([&](int i) { return (need(i) - 0.01) * std::cos(theta(i)); });
        t.needs.least[std::size_t(BiasFamily::Normal)] = one;
        return t;
    }
};

BiasSearch searched(const MadeUpFrame& frame, const BiasSearch::Options& options = {}) {
    BiasSearch search(Settings{}, options);
    double progress = 0;
    for (int i = 0; i < 200 && !search.done(); ++i) {
        search.add_trial(frame.shown(search.next_settings().bias));
        EXPECT_GE(search.progress(), progress);
        progress = search.progress();
    }
    EXPECT_TRUE(search.done());
    return search;
}

TEST(BiasSearch, FindsTheMinimumFactorOfEachFamily) {
    for (const double harder : {0.4, 0.97, 1.0, 1.8}) {
        SCOPED_TRACE(harder);
        const MadeUpFrame frame{.harder = harder};
        const BiasSearch search = searched(frame);
        ASSERT_EQ(search.found().size(), kBiasFamilies);
        EXPECT_LT(search.trials(), 60);
        for (const BiasFound& f : search.found()) {
            EXPECT_EQ(frame.shown(f.bias).acne(), 0u) << family_label(f.family);
            EXPECT_GT(frame.shown(scale_bias(f.bias, 0.97)).acne(), 0u) << family_label(f.family) << ": not the least";
            EXPECT_EQ(f.trial.acne(), 0u);
        }
        if (harder > 1) continue;
        EXPECT_EQ(search.best()->family, BiasFamily::Normal) << "it costs least at flat light";
    }
}

TEST(BiasSearch, QuickSearchUsesTheory) {
    const BiasSearch search = searched({.harder = 0.8}, {.only = BiasFamily::Slope, .quick = true});
    ASSERT_EQ(search.found().size(), 1u);
    EXPECT_EQ(search.found()[0].factor, 1);
    EXPECT_EQ(search.trials(), 2);
    const BiasSearch harder = searched({.harder = 1.3}, {.only = BiasFamily::Slope, .quick = true});
    ASSERT_TRUE(harder.best());
    EXPECT_GE(harder.best()->factor, 1.3);
    EXPECT_LT(harder.best()->factor, 1.3 * 1.25);
}

TEST(BiasSearch, AvoidsLeaksBeforeGaps) {
    const BiasSearch search = searched({.lost_by_normal = 200});
    EXPECT_NE(search.best()->family, BiasFamily::Normal);
}

TEST(BiasSearch, ReportsFailure) {
    const BiasSearch search = searched({.harder = 1e5});
    EXPECT_TRUE(search.found().empty());
    EXPECT_EQ(search.best(), nullptr);
    ASSERT_NE(search.nearest(), nullptr);
    EXPECT_GT(search.nearest()->trial.acne(), 0u);
    BiasSearch dark(Settings{});
    dark.add_trial({});
    EXPECT_TRUE(dark.done()) << "nothing is lit";
}

/// World of made-up errors and times of kernels and resolutions: finer maps and wider kernels are more accurate and
/// slower.
struct MadeUpWorld {
    static double ms(const Settings& s) {
        return 1 + 1e-6 * s.map.resolution * s.map.resolution + 0.5 * cost_of(s).sampler_taps / 9.0;
    }
    static double error(const Settings& s) {
        return 2.0 / s.map.resolution / std::sqrt(double(taps_across(filter_of(s), s)));
    }
    int classified = 0;
    std::vector<Settings> timed;

    Tuner run(const TuneGoals& goals) {
        Tuner tuner(Settings{}, goals);
        for (int i = 0; i < 1000 && tuner.action() != Tuner::Action::None; ++i) {
            const Settings s = tuner.settings();
            if (tuner.action() == Tuner::Action::Time) {
                timed.push_back(s);
                tuner.add_time(ms(s));
                continue;
            }
            ++classified;
            const MadeUpFrame frame{.kappa = reach_of(s).bias};
            BiasTrial t = frame.shown(s.bias);
            t.error.mae = error(s);
            tuner.add_trial(t);
        }
        EXPECT_EQ(tuner.action(), Tuner::Action::None);
        EXPECT_EQ(tuner.progress(), 1);
        return tuner;
    }
    /// Returns the optimum by exhaustive search.
    static std::optional<Settings> best(const TuneGoals& goals) {
        std::optional<Settings> best;
        for (const std::string_view kernel : sweep_kernels())
            for (int n = 256; n <= goals.max_resolution; n *= 2) {
                Settings s;
                set_setting(s, "filter.kernel", kernel);
                s.map.resolution = n;
                if (goals.max_error && error(s) > *goals.max_error) continue;
                if (goals.max_ms && ms(s) > *goals.max_ms) continue;
                const auto cost = [&](const Settings& t) { return goals.max_error ? ms(t) : error(t); };
                if (!best || cost(s) < cost(*best)) best = s;
            }
        return best;
    }
};

TEST(Tuner, WithoutLimitsChangesTheBiasOnly) {
    MadeUpWorld world;
    const Tuner tuner = world.run({});
    ASSERT_TRUE(tuner.result());
    Settings expected;
    expected.bias = tuner.bias().best()->bias;
    EXPECT_EQ(*tuner.result(), expected);
    EXPECT_TRUE(tuner.candidates().empty());
    EXPECT_NE(tuner.summary().find("least bias without acne: bias.normal"), std::string::npos) << tuner.summary();
}

TEST(Tuner, FindsTheCheapestWithinTheErrorAndTheMostAccurateWithinTheTime) {
    for (const TuneGoals& goals : {TuneGoals{.max_error = 0.001}, TuneGoals{.max_error = 0.003}, TuneGoals{.max_ms = 3},
                                   TuneGoals{.max_ms = 1.2}, TuneGoals{.max_error = 0.002, .max_ms = 3}}) {
        MadeUpWorld world;
        const Tuner tuner = world.run(goals);
        ASSERT_TRUE(tuner.result());
        const Settings best = *MadeUpWorld::best(goals);
        EXPECT_EQ(tuner.result()->filter, best.filter);
        EXPECT_EQ(tuner.result()->map.resolution, best.map.resolution);
        ASSERT_TRUE(tuner.best());
        EXPECT_EQ(tuner.best()->trial->acne(), 0u);
        for (const Settings& timed : world.timed) {
            if (!goals.max_ms || timed.map.resolution == 256) continue;
            Settings coarser;
            coarser.filter = timed.filter;
            coarser.map.resolution = timed.map.resolution / 2;
            EXPECT_LE(MadeUpWorld::ms(coarser), *goals.max_ms) << "finer maps than one that is too slow are not tried";
        }
    }
}

TEST(Tuner, ReportsTheNearestResultIfLimitsAreUnreachable) {
    MadeUpWorld world;
    const Tuner impossible = world.run({.max_error = 1e-7});
    EXPECT_FALSE(impossible.result());
    EXPECT_NE(impossible.summary().find("no kernel and resolution is within the limits: the least mae was"),
              std::string::npos)
        << impossible.summary();
    const Tuner too_fast = world.run({.max_ms = 0.01});
    EXPECT_FALSE(too_fast.result());
    EXPECT_NE(too_fast.summary().find("no kernel"), std::string::npos);
}

}  // namespace
}  // namespace si
