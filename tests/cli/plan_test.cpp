// Tests of `plan`: text and JSON.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "renderer/frame/optimisation_set.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

Json plan_of(const Words& more) {
    return program_json("plan boxes --size 160x90" + more);
}

const Json& effect_of(const Json& plan, const std::string& name) {
    static const Json none;
    for (const Json& e : plan["effects"])
        if (e["name"] == name) return e;
    ADD_FAILURE() << name << " is no effect";
    return none;
}

TEST(PlanCommand, PrintsEffectsWithReasonsAndTimesOnlyIfMeasured) {
    const Json plan = plan_of({});
    EXPECT_EQ(plan["format"], "shadow-inspector-plan");
    EXPECT_GT(plan["effects"].size(), 20u);
    for (const Json& e : plan["effects"]) {
        const std::string state = e["state"];
        EXPECT_TRUE(state == "simulated" || state == "reused" || state == "not called for") << state;
        EXPECT_FALSE(e["reason"].get<std::string>().empty()) << e["name"];
        for (const char* time : {"saved_ms", "saved_ms_low", "saved_ms_high", "saved_together", "ms"})
            EXPECT_TRUE(e.at(time).is_null()) << e["name"];
    }
    EXPECT_EQ(effect_of(plan, "shadow map 0 (directional)")["state"], "simulated");
    EXPECT_EQ(effect_of(plan, "contact shadows of light 0")["state"], "not called for");
    EXPECT_EQ(effect_of(plan, "numeric health")["state"], "not called for");
    EXPECT_EQ(plan["savings"].size(), kOptimisations);
    EXPECT_TRUE(plan["waste"].is_null());
    EXPECT_TRUE(plan["shadow_ms"].is_null() && plan["forced_more_ms"].is_null());
    const Json without_caster = plan_of("--set light.cast=false");
    EXPECT_EQ(effect_of(without_caster, "shadow map 0 (directional)")["reason"], "light.cast is off.");
    const ProcessResult text = run_program("plan boxes --size 64x48");
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_EQ(test::lacking(text.out, {"–", "shadow map 0"}), "") << "a dash for each missing measurement";
}

TEST(PlanCommand, MeasuresTheNamedEffects) {
    const Json plan = plan_of("--measure --rounds 4 --set light.cast=false --set shading.separate_visibility=true");
    EXPECT_EQ(plan["rounds"], 4);
    EXPECT_GT(plan["frame_ms"], 0);
    for (const std::string ms : {"shadow_ms", "forced_more_ms"}) {
        ASSERT_TRUE(plan[ms].is_number()) << ms;
        EXPECT_LE(plan[ms + "_low"], plan[ms]);
        EXPECT_GE(plan[ms + "_high"], plan[ms]);
    }
    const Json& skipped = effect_of(plan, "look-ups of light 0");
    EXPECT_EQ(skipped["saving"], "uncalled");
    ASSERT_TRUE(skipped["saved_ms"].is_number());
    EXPECT_LE(skipped["saved_ms_low"], skipped["saved_ms"]);
    EXPECT_GE(skipped["saved_ms_high"], skipped["saved_ms"]);
    EXPECT_GT(effect_of(plan, "shading (reads visibility)")["ms"], 0);
    EXPECT_TRUE(effect_of(plan, "depth blur")["saved_ms"].is_null()) << "nothing spares it: never estimated";
}

SI_TEST_IS(Later, PlanCommand, PrintsTheNumberOfEffectsThatShareATime);
TEST(PlanCommand, PrintsTheNumberOfEffectsThatShareATime) {
    const Words measured = "--measure --rounds 3 --set light.type=point --set map.resolution=256";
    const Json plan = plan_of(measured);
    int faces = 0;
    for (const Json& e : plan["effects"]) faces += e["saving"] == "views";
    ASSERT_GT(faces, 1);
    for (const Json& e : plan["effects"]) {
        if (e["saving"] == "views") {
            EXPECT_EQ(e["saved_together"], faces) << e["name"];
        }
        EXPECT_EQ(e["saved_together"].is_null(), e["saved_ms"].is_null()) << e["name"];
    }
    EXPECT_EQ(effect_of(plan, "visibility")["saved_together"], 1);
    const ProcessResult text = run_program("plan boxes --size 160x90" + measured);
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_NE(text.out.find("), of " + std::to_string(faces) + " together"), std::string::npos) << text.out;
}

TEST(PlanCommand, ListsTheSearchThatItRequests) {
    const Json plan = plan_of("--check-numeric");
    EXPECT_EQ(effect_of(plan, "numeric health")["state"], "simulated");
    EXPECT_EQ(effect_of(plan, "visibility")["state"], "simulated") << "which is searched, too";
}

SI_TEST_IS(Later, PlanCommand, ListsWaste);
TEST(PlanCommand, ListsWaste) {
    const Json waste = plan_of("--waste --set light.cascades=2")["waste"];
    std::vector<std::string> maps, others;
    for (const Json& tried : waste["tried"])
        (tried["texels_read"].is_null() ? others : maps).push_back(tried["name"].get<std::string>());
    EXPECT_EQ(maps.size(), 2u);
    EXPECT_EQ(others, (std::vector<std::string>{"sky and its ambient light", "tone curve"}));
    EXPECT_GT(waste["triangles"], 0);
    EXPECT_LE(waste["wasted_triangles"], waste["triangles"]);
    for (const char* time : {"maps_ms", "wasted_ms", "share_of_time"}) EXPECT_TRUE(waste.at(time).is_null()) << time;
    const std::string off = run_program("plan boxes --waste --size 64x36 --set light.on=false").out;
    EXPECT_NE(off.find("not drawn          0 triangles  map of light 0\n"), std::string::npos) << off;
}

SI_TEST_IS(Slow, PlanCommand, AnInterruptPrintsTheWasteSoFar);
TEST(PlanCommand, AnInterruptPrintsTheWasteSoFar) {
    // 96 maps, so that the search lasts. The second line of progress follows the first trial.
    std::string lights = "--set light.count=16";
    for (int i = 0; i < 16; ++i) lights += " --set light." + std::to_string(i) + ".type=point";
    const ProcessResult r =
        run_shell("$SI plan boxes --waste --size 1280x720 --set map.resolution=512 " + lights + " >printed 2>said & " +
                      signal_once("[ $(grep -c 'of light' said) -gt 1 ]", "INT") + "cat printed said",
                  fresh_test_folder());
    // A fast machine may end before the signal.
    const bool interrupted = r.out.find("code 130\n") != std::string::npos;
    EXPECT_EQ(r.out.find("stopped before all work was left out once") != std::string::npos, interrupted) << r.out;
    EXPECT_EQ(r.out.find("interrupted; not everything was tried") != std::string::npos, interrupted) << r.out;
}

TEST(PlanCommand, RanksWasteByMeasuredTime) {
    const Json waste = plan_of("--waste --measure --rounds 3 --set light.intensity=1e-10")["waste"];
    EXPECT_EQ(waste["share"], 1) << "nobody sees so dim a light";
    EXPECT_GT(waste["maps_ms"], 0);
    EXPECT_LE(waste["share_of_time"], 1);
    EXPECT_TRUE(waste["tried"][0]["maps_ms"].is_number());
}

TEST(PlanCommand, TracesRaysForShownOutputs) {
    const Json plan = plan_of("--set view.overlay=artefacts --set map.resolution=256");
    EXPECT_EQ(effect_of(plan, "rays of the reference")["state"], "simulated");
    EXPECT_EQ(effect_of(plan, "causes found")["state"], "simulated");
    EXPECT_EQ(effect_of(plan_of("--set light.source=traced"), "rays of the reference")["state"], "simulated");
}

}  // namespace
}  // namespace si
