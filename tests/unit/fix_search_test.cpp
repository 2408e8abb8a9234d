// Tests of the search for fixes with made-up measurements: which trials are timed, which are not drawn, and which one
// is the fix.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "app/report/fixes_json.h"
#include "renderer/advise/fixes.h"

namespace si {
namespace {

constexpr std::size_t kPixels = 100;

/// Made-up effect of one candidate. The candidate's number is its bias.constant; 0 is the present settings.
struct Effect {
    std::size_t wrong = 0;    ///< wrong pixels of kPixels
    double ms = 10;           ///< frame time
    std::uint64_t bytes = 1;  ///< bytes of the maps
};

/// Meter over made-up effects that notes what is drawn and timed.
class MadeUpFrames {
public:
    /// @param effects of the present settings, and of each candidate
    explicit MadeUpFrames(std::vector<Effect> effects) : effects_(std::move(effects)) {
        auto reference = std::make_shared<Reference>();
        reference->width = kPixels;
        reference->height = 1;
        reference->visibility = {kPixels, 1, 1, std::vector<float>(kPixels, 1.f)};
        reference_ = reference;
        meter.measure = [this](const Settings& s, int) {
            drawn.push_back(number(s));
            return measured(s);
        };
        meter.time = [this](const Settings& a, const Settings& b) {
            timed.push_back(number(b));
            const auto ms = [this](const Settings& s) { return s.lights[0].cast ? effect(s).ms : kUnshadowed_ms; };
            return CostChange{ms(b) - ms(a), 0.1};
        };
        meter.map_bytes = [this](const Settings& s) { return effect(s).bytes; };
    }
    /// @param enough trials after which the search ends at the first fix @param shown receives the table so far
    FixTable search(
        std::size_t enough = std::numeric_limits<std::size_t>::max(),
        const std::function<void(const FixTable&)>& shown = [](const FixTable&) {}) {
        std::vector<Candidate> list;
        for (std::size_t i = 1; i < effects_.size(); ++i) {
            list.push_back({.name = std::to_string(i), .settings = {}});
            list.back().settings.bias.constant = double(i);
        }
        Settings base;
        base.bias.constant = 0;
        return search_fixes(base, measured(base), std::move(list), meter, {}, {}, shown, enough);
    }
    TrialMeter meter;
    std::vector<int> drawn, timed;

private:
    static constexpr double kUnshadowed_ms = 5;
    std::vector<Effect> effects_;
    std::shared_ptr<const Reference> reference_;

    static int number(const Settings& s) { return int(s.bias.constant); }
    const Effect& effect(const Settings& s) const { return effects_[std::size_t(number(s))]; }
    MeasuredSettings measured(const Settings& s) const {
        const Effect& e = effect(s);
        auto frame = std::make_shared<MeasuredError>();
        frame->traced.reference = reference_;
        frame->classified.resize(kPixels);
        for (std::size_t i = 0; i < e.wrong; ++i) {
            frame->classified[i].artefact = Artefact::Acne;
            frame->classified[i].bits = ClassifiedPixel::kFalseShadow;
        }
        frame->metrics.counted = kPixels;
        frame->metrics.artefacts[std::size_t(Artefact::Acne)] = e.wrong;
        frame->metrics.mae = double(e.wrong) / kPixels;
        frame->map_resolution = s.map.resolution;
        return {.error = frame->metrics.mae, .noise = 0, .work = {.map_bytes = e.bytes}, .camera = {}, .frame = frame};
    }
};

const Trial& row_of(const FixTable& table, const std::string& name) {
    for (const Trial& t : table.rows)
        if (t.candidate.name == name) return t;
    throw std::runtime_error("no row " + name);
}

TEST(FixSearch, TimesTheFirstFixAndAtTheEndTheBest) {
    MadeUpFrames frames({{100}, {50}, {30}, {10}, {20}});
    const FixTable table = frames.search();
    ASSERT_TRUE(table.fix());
    EXPECT_EQ(table.fix()->candidate.name, "3");
    EXPECT_EQ(frames.drawn, (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ(frames.timed, (std::vector<int>{1, 3})) << "the first fix, the best";
    EXPECT_NE(row_of(table, "4").why_not, "");
    EXPECT_FALSE(row_of(table, "4").ms);
}

TEST(FixSearch, TakesTheNextBestWhereTheBestCostsMoreThanTheShadow) {
    MadeUpFrames frames({{100}, {50}, {10, 40}, {20, 12}, {30}});
    const FixTable table = frames.search();
    ASSERT_TRUE(table.fix());
    EXPECT_EQ(table.fix()->candidate.name, "3");
    EXPECT_EQ(frames.timed, (std::vector<int>{1, 2, 0, 3})) << "the shadow itself once a change costs time";
    EXPECT_NE(row_of(table, "2").why_not.find("ms more"), std::string::npos) << row_of(table, "2").why_not;
}

TEST(FixSearch, DrawsNoLargerMapsOnceMostPixelsHaveAFix) {
    MadeUpFrames frames({{100}, {15}, {5, 10, 4}, {5, 10, 2}});
    const FixTable table = frames.search();
    EXPECT_EQ(frames.drawn, (std::vector<int>{1, 3})) << "twice the bytes are allowed";
    EXPECT_EQ(row_of(table, "2").candidate.untried,
              "maps would take more than twice the bytes (+0 KiB); a fix with smaller ones puts 85 % of the wrong "
              "pixels right");
    EXPECT_EQ(table.fix()->candidate.name, "3");
}

TEST(FixSearch, DrawsLargerMapsWhileManyPixelsStayWrong) {
    MadeUpFrames frames({{100}, {25}, {5, 10, 4}});
    const FixTable table = frames.search();
    EXPECT_EQ(frames.drawn, (std::vector<int>{1, 2}));
    EXPECT_EQ(row_of(table, "2").cured, 95u);
    EXPECT_NE(row_of(table, "2").why_not.find("twice the bytes"), std::string::npos);
    EXPECT_EQ(table.fix()->candidate.name, "1");
}

TEST(FixSearch, NeverDrawsMapsOfMoreThanFourTimesTheBytes) {
    MadeUpFrames frames({{100}, {95}, {5, 10, 4}, {1, 10, 5}});
    const FixTable table = frames.search();
    EXPECT_EQ(frames.drawn, (std::vector<int>{1, 2}));
    EXPECT_EQ(row_of(table, "3").candidate.untried, "maps would take more than 4 times the bytes (+0 KiB)");
    EXPECT_EQ(table.fix()->candidate.name, "1");
}

TEST(FixSearch, TimesTheFirstFixInFewRoundsAndInAllIfItStays) {
    MadeUpFrames frames({{100}, {50}, {60}});
    std::vector<double> limits_ms;
    frames.meter.time_to_limit = [&](const Settings&, const Settings&, double limit_ms) {
        limits_ms.push_back(limit_ms);
        return CostChange{0, 30};
    };
    const FixTable table = frames.search();
    ASSERT_TRUE(table.fix());
    EXPECT_EQ(table.fix()->candidate.name, "1");
    EXPECT_EQ(limits_ms, std::vector<double>{std::numeric_limits<double>::infinity()})
        << "ends after the fewest rounds";
    EXPECT_EQ(frames.timed, std::vector<int>{1});
    EXPECT_EQ(table.fix()->ms->noise, 0.1) << "the time of all rounds";
}

TEST(FixSearch, TheFirstFixIsNoneIfAllRoundsFindItTooSlow) {
    MadeUpFrames frames({{100}, {50, 40}, {60}});
    frames.meter.time_to_limit = [](const Settings&, const Settings&, double) { return CostChange{0, 30}; };
    const FixTable table = frames.search();
    ASSERT_TRUE(table.fix());
    EXPECT_EQ(table.fix()->candidate.name, "2");
    EXPECT_NE(row_of(table, "1").why_not.find("ms more"), std::string::npos) << row_of(table, "1").why_not;
}

TEST(FixSearch, GoesOnIfAllRoundsRefuseTheFixAtWhichItWouldEnd) {
    MadeUpFrames frames({{100}, {50, 40}, {60}, {40}});
    frames.meter.time_to_limit = [](const Settings&, const Settings&, double) { return CostChange{0, 30}; };
    const FixTable table = frames.search(1);
    EXPECT_EQ(frames.drawn, (std::vector<int>{1, 2})) << "ends at the second one, which is a fix";
    ASSERT_TRUE(table.fix());
    EXPECT_EQ(table.fix()->candidate.name, "2");
}

TEST(FixSearch, AStoppedSearchHasTheFirstFix) {
    MadeUpFrames frames({{100}, {50}, {10}, {5}});
    frames.meter.measure = [&, measure = frames.meter.measure](const Settings& s, int light) {
        if (int(s.bias.constant) == 3) throw Cancelled();
        return measure(s, light);
    };
    const FixTable table = frames.search();
    EXPECT_TRUE(table.stopped);
    ASSERT_TRUE(table.fix());
    EXPECT_EQ(table.fix()->candidate.name, "1") << "the better one was not timed";
    EXPECT_EQ(table.rows.size(), 2u);
}

TEST(FixSearch, TimesOnlyTheBestWhereNoTableIsShown) {
    MadeUpFrames frames({{100}, {50}, {30}, {10}, {20}});
    const FixTable table = frames.search(std::numeric_limits<std::size_t>::max(), {});
    ASSERT_TRUE(table.fix());
    EXPECT_EQ(table.fix()->candidate.name, "3");
    EXPECT_EQ(frames.timed, std::vector<int>{3});
    EXPECT_EQ(table.untimed_fix()->candidate.name, "4") << "the next best";
}

TEST(FixSearch, AStoppedSearchWithoutATimedFixNamesTheBestUntimedOne) {
    MadeUpFrames frames({{100}, {50}, {10}, {5}});
    frames.meter.measure = [&, measure = frames.meter.measure](const Settings& s, int light) {
        if (int(s.bias.constant) == 3) throw Cancelled();
        return measure(s, light);
    };
    const FixTable table = frames.search(std::numeric_limits<std::size_t>::max(), {});
    EXPECT_TRUE(table.stopped);
    EXPECT_FALSE(table.fix());
    ASSERT_TRUE(table.untimed_fix());
    EXPECT_EQ(table.untimed_fix()->candidate.name, "2");
    EXPECT_TRUE(frames.timed.empty());
    testing::internal::CaptureStdout();
    print_fixes(table, 0, {});
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_EQ(text.rfind("no fix is known yet: 2 is one if it costs no more time than the shadow does\n", 0), 0u)
        << text;
}

TEST(FixSearch, KeepsAllRowsWhenStoppedWhileTiming) {
    for (const int last : {1, 2}) {
        MadeUpFrames frames({{100}, {50}, {last == 1 ? 60u : 10u}});
        frames.meter.time_to_limit = [](const Settings&, const Settings&, double) { return CostChange{0, 30}; };
        frames.meter.time = [](const Settings&, const Settings&) -> CostChange { throw Cancelled(); };
        const FixTable table = frames.search();
        EXPECT_TRUE(table.stopped);
        EXPECT_EQ(table.rows.size(), 2u) << "stopped while trial " << last << " was timed";
        ASSERT_TRUE(table.fix());
        EXPECT_EQ(table.fix()->candidate.name, "1");
    }
}

}  // namespace
}  // namespace si
