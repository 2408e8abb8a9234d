// The plan of a frame: what runs follows from what is wanted, and each decision says why.
#include "renderer/frame/plan.h"

#include <gtest/gtest.h>

#include <set>

namespace si {
namespace {

Pass pass_of(std::string name, std::vector<ResultRef> reads, std::vector<ResultRef> writes,
             std::uint64_t* cached = nullptr) {
    return {.name = std::move(name),
            .reads = std::move(reads),
            .writes = std::move(writes),
            .key = 7,
            .cached = cached,
            .run = [](PassInfo&) {},
            .idle_reason = "idle"};
}

TEST(PlanTest, WhatIsWantedRunsWithAllThatItReads) {
    const std::vector<Pass> passes = {
        pass_of("maps", {}, {Result::ShadowMaps}),
        pass_of("moments", {Result::ShadowMaps}, {Result::Moments}),
        pass_of("shading", {Result::ShadowMaps}, {Result::Shaded}),
        pass_of("values 0", {Result::Moments}, {{Result::Overlay, 0}}),
        pass_of("values 1", {}, {{Result::Overlay, 1}}),
    };
    const auto ran = [&](std::vector<ResultRef> wanted) {
        std::set<std::string> names;
        for (const PassInfo& p : plan_passes(passes, wanted, false, false))
            if (p.state == PassState::Ran) names.insert(p.name);
        return names;
    };
    using Names = std::set<std::string>;
    EXPECT_EQ(ran({}), Names{});
    EXPECT_EQ(ran({Result::Shaded}), (Names{"maps", "shading"}));
    EXPECT_EQ(ran({{Result::Overlay, 1}}), Names{"values 1"}) << "each pane's result is its own";
    EXPECT_EQ(ran({Result::Overlay, Result::Shaded}), (Names{"maps", "moments", "shading", "values 0"}));
}

TEST(PlanTest, EachDecisionSaysWhy) {
    std::uint64_t holds = 7, other = 6;
    std::vector<Pass> passes = {pass_of("held", {}, {Result::Shaded}, &holds),
                                pass_of("changed", {}, {Result::Visibility}, &other),
                                pass_of("uncalled", {}, {Result::Moments}), pass_of("unread", {}, {Result::Truth})};
    passes[2].unneeded = "no kernel reads them";
    const std::vector<ResultRef> wanted = {Result::Shaded, Result::Visibility, Result::Moments};
    const auto told = [&](bool force, bool no_skip) {
        std::vector<std::pair<PassState, std::string>> out;
        for (const PassInfo& p : plan_passes(passes, wanted, force, no_skip)) out.emplace_back(p.state, p.reason);
        return out;
    };
    using Told = std::vector<std::pair<PassState, std::string>>;
    EXPECT_EQ(told(false, false), (Told{{PassState::Reused, "nothing it depends on changed"},
                                        {PassState::Ran, "its inputs changed"},
                                        {PassState::Skipped, "no kernel reads them"},
                                        {PassState::Skipped, "idle"}}));
    EXPECT_EQ(told(true, true), (Told{{PassState::Ran, "asked to run"},
                                      {PassState::Ran, "its inputs changed"},
                                      {PassState::Ran, "its inputs changed"},
                                      {PassState::Skipped, "idle"}}));
    EXPECT_EQ(holds, 7u) << "a plan changes nothing";
}

TEST(PlanTest, EveryResultHasWordsOfItsOwn) {
    std::set<std::string_view> words;
    for (int i = 0; i <= int(Result::MapView); ++i) {
        EXPECT_FALSE(result_name(Result(i)).empty()) << i;
        EXPECT_TRUE(words.insert(result_name(Result(i))).second) << result_name(Result(i));
    }
}

}  // namespace
}  // namespace si
