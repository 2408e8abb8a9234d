// Tests of the frame plan: passes follow from requested results, and each decision has a reason.
#include "renderer/frame/plan.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "renderer/base/index_of.h"

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

TEST(PlanTest, RequestedPassesRunWithTheirInputs) {
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
            if (p.state == PassState::Drawn) names.insert(p.name);
        return names;
    };
    using Names = std::set<std::string>;
    EXPECT_EQ(ran({}), Names{});
    EXPECT_EQ(ran({Result::Shaded}), (Names{"maps", "shading"}));
    EXPECT_EQ(ran({{Result::Overlay, 1}}), Names{"values 1"}) << "each pane's result is its own";
    EXPECT_EQ(ran({Result::Overlay, Result::Shaded}), (Names{"maps", "moments", "shading", "values 0"}));
}

TEST(PlanTest, AidsFollowRunningPassesAndChangeNoKey) {
    std::uint64_t maps_held = 0, aid_held = 0, shading_held = 0;
    const auto plan_with = [&](bool aids) {
        Plan plan;
        plan.add_pass(pass_of("maps", {}, {Result::ShadowMaps}, &maps_held));
        Pass aid = pass_of("bounds", {Result::ShadowMaps}, {Result::MapBounds}, &aid_held);
        aid.only_saves_work = true;
        if (!aids) aid.unneeded = "not now";
        plan.add_pass(std::move(aid));
        plan.add_pass(pass_of("shading", {Result::ShadowMaps, Result::MapBounds}, {Result::Shaded}, &shading_held));
        return plan;
    };
    const auto states = [&](const Plan& plan) {
        std::vector<PassState> out;
        for (const PassInfo& p : plan_passes(plan.passes(), {Result::Shaded}, false, false)) out.push_back(p.state);
        return out;
    };
    using States = std::vector<PassState>;
    const Plan plain = plan_with(false), aided = plan_with(true);
    EXPECT_EQ(plain.passes()[2].key, aided.passes()[2].key);
    EXPECT_FALSE(aided.is_current(Result::ShadowMaps));
    EXPECT_EQ(states(aided), (States{PassState::Drawn, PassState::Drawn, PassState::Drawn}));
    maps_held = aided.passes()[0].key;
    EXPECT_TRUE(aided.is_current(Result::ShadowMaps));
    EXPECT_EQ(states(aided), (States{PassState::Cached, PassState::Drawn, PassState::Drawn}));
    shading_held = aided.passes()[2].key;
    EXPECT_EQ(states(aided), (States{PassState::Cached, PassState::Skipped, PassState::Cached}))
        << "nothing is made anew that it could help";
    aid_held = aided.passes()[1].key;
    EXPECT_EQ(states(aided), (States{PassState::Cached, PassState::Cached, PassState::Cached}));
    EXPECT_EQ(states(plain), (States{PassState::Cached, PassState::Skipped, PassState::Cached}));
}

TEST(PlanTest, EachDecisionHasAReason) {
    std::uint64_t holds = 7, other = 6;
    std::vector<Pass> passes = {pass_of("held", {}, {Result::Shaded}, &holds),
                                pass_of("changed", {}, {Result::Visibility}, &other),
                                pass_of("uncalled", {}, {Result::Moments}), pass_of("unread", {}, {Result::Reference})};
    passes[2].unneeded = "no kernel reads them";
    const std::vector<ResultRef> wanted = {Result::Shaded, Result::Visibility, Result::Moments};
    const auto decisions = [&](bool force, bool skip_unneeded) {
        std::vector<std::pair<PassState, std::string>> out;
        for (const PassInfo& p : plan_passes(passes, wanted, force, skip_unneeded)) out.emplace_back(p.state, p.reason);
        return out;
    };
    using Decisions = std::vector<std::pair<PassState, std::string>>;
    EXPECT_EQ(decisions(false, false), (Decisions{{PassState::Cached, "its inputs are unchanged"},
                                                  {PassState::Drawn, "its inputs changed"},
                                                  {PassState::Skipped, "no kernel reads them"},
                                                  {PassState::Skipped, "idle"}}));
    EXPECT_EQ(decisions(true, true), (Decisions{{PassState::Drawn, "forced by the request"},
                                                {PassState::Drawn, "its inputs changed"},
                                                {PassState::Drawn, "its inputs changed"},
                                                {PassState::Skipped, "idle"}}));
    EXPECT_EQ(holds, 7u) << "a plan changes nothing";
}

TEST(PlanTest, KeyDependsOnInputs) {
    const auto keys = [](std::uint64_t maps, std::uint64_t own) {
        Plan plan;
        for (const std::uint64_t key : {std::uint64_t(1), maps}) {  // two lights' maps
            Pass pass = pass_of("maps", {}, {Result::ShadowMaps});
            pass.key = key;
            plan.add_pass(std::move(pass));
        }
        Pass shading = pass_of("shading", {Result::ShadowMaps, Result::Visibility}, {Result::Shaded});
        shading.key = own;
        plan.add_pass(std::move(shading));
        plan.add_pass(pass_of("values", {}, {Result::Overlay}));
        plan.add_pass(pass_of("composed", {Result::Shaded, Result::Overlay}, {Result::Composed}));
        return std::array{plan.key_of(Result::Shaded), plan.key_of(Result::Overlay), plan.key_of(Result::Composed)};
    };
    const auto base = keys(2, 3), other_map = keys(4, 3), other_own = keys(2, 4);
    EXPECT_EQ(base, keys(2, 3));
    for (const auto& changed : {other_map, other_own}) {
        EXPECT_NE(changed[0], base[0]);
        EXPECT_EQ(changed[1], base[1]) << "it reads none of it";
        EXPECT_NE(changed[2], base[2]) << "through what it reads";
    }
}

TEST(PlanTest, ResultsAreStoredByTheirOwner) {
    Plan plan;
    gl::Target maps, first, second;
    plan.place_result(Result::ShadowMaps, {&maps, 3});
    plan.place_result({Result::Overlay, 1}, {&first});
    plan.place_result({Result::Overlay, 1}, {&second});
    EXPECT_EQ(&plan.target(Result::ShadowMaps), &maps);
    EXPECT_EQ(plan.images(Result::ShadowMaps).at(0).unit, 3);
    EXPECT_EQ(&plan.target({Result::Overlay, 1}, 1), &second);
    EXPECT_FALSE(plan.target(Result::Overlay).texture) << "of another pane";
    EXPECT_FALSE(plan.target({Result::Overlay, 1}, 2).texture);
    int given_up = 0;
    plan.release_later([&] { ++given_up; });
    EXPECT_EQ(given_up, 0);
    plan.run_releases();
    EXPECT_EQ(given_up, 1);
}

TEST(PlanTest, EveryResultHasItsOwnName) {
    std::set<std::string_view> words;
    for (int i = 0; i <= index_of(Result::MapView); ++i) {
        EXPECT_FALSE(result_name(Result(i)).empty()) << i;
        EXPECT_TRUE(words.insert(result_name(Result(i))).second) << result_name(Result(i));
    }
}

}  // namespace
}  // namespace si
