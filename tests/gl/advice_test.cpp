// Tests advice on built-in scenes: each suggested change is made and measured again.
#include "renderer/advise/advice.h"

#include "renderer/advise/autopilot.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class AdviceTest : public FrameTest {
protected:
    ReferenceCache cache;
    int width = 240, height = 160;
    SearchTools tools(const Scene& scene) { return {renderer, scene, width, height, cache}; }

    /// Returns a meter whose clock counts work, so that ranks do not depend on the machine.
    TrialMeter meter_by_work(const Scene& scene) {
        TrialMeter meter = renderer_trial_meter(tools(scene));
        meter.time = [measure = meter.measure](const Settings& a, const Settings& b) {
            const auto work = [&](const Settings& s) { return 1e-6 * double(measure(s, 0).work.bytes_touched); };
            return CostChange{work(b) - work(a), 1e-9};
        };
        return meter;
    }

    std::vector<Trial> advised(const Scene& scene, const Settings& s) {
        const AdviceFacts facts = advice_facts(tools(scene), s);
        return try_advice(s, advice_candidates(s, facts), meter_by_work(scene));
    }

    /// Makes each suggested change as the editor and --set do, and measures the result as `measure` does.
    void expect_predicted_effects(const Scene& scene, const Settings& s, const std::vector<Trial>& all) {
        Measurer measurer(renderer, width, height);
        Settings classified_as = s;
        std::size_t shown = 0;
        for (const Trial& t : all) {
            if (!t.why_not.empty()) continue;
            ++shown;
            SCOPED_TRACE(t.candidate.name);
            Settings with = s;
            for (const auto& [key, value] : t.changes) set_setting(with, key, value);
            classified_as.view.light = with.view.light = t.candidate.light;
            const Classification before = measurer.classify(scene, classified_as),
                                 after = measurer.classify(scene, with);
            EXPECT_EQ(before.error.mae, t.before.error);
            EXPECT_EQ(after.error.mae, t.after.error) << "equal to the prediction";
            if (t.candidate.claim == Claim::Same) {
                EXPECT_LE(after.error.mae, before.error.mae + t.tolerance());
            }
            if (!(after.error.mae < before.error.mae)) {
                EXPECT_NE(t.candidate.claim, Claim::Right);
                EXPECT_LT(after.cost.bytes_touched, before.cost.bytes_touched) << "there is less to do";
            }
        }
        EXPECT_GT(shown, 0u);
    }

    static bool has(const std::vector<Trial>& all, std::string_view rule) {
        return std::any_of(all.begin(), all.end(),
                           [&](const Trial& t) { return t.why_not.empty() && t.candidate.rule == rule; });
    }
};

SI_TESTS_ARE(DriverIndependent, AdviceTest);
SI_TESTS_ARE(Repeated, AdviceTest);
SI_TEST_IS(Slow, AdviceTest, ItsPredictionsHoldOnBuiltInScenes);
TEST_F(AdviceTest, ItsPredictionsHoldOnBuiltInScenes) {
    for (const char* name : {"boxes", "teapot"}) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(name);
        const Settings s = settings_for(scene);
        expect_predicted_effects(scene, s, advised(scene, s));
    }
}

SI_TEST_IS(Slow, AdviceTest, FindsSettingsWithoutEffect);
TEST_F(AdviceTest, FindsSettingsWithoutEffect) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = settings_for(scene, {"filter.kernel=pcss", "light.size=0.01", "light.cascades=4"});
    std::vector<Trial> all = advised(scene, s);
    EXPECT_TRUE(has(all, "narrow-penumbra"));
    expect_predicted_effects(scene, s, all);
    // Too little bias: the change corrects pixels.
    s = settings_for(scene, {"bias.kind=constant"});
    all = advised(scene, s);
    EXPECT_TRUE(has(all, "bias"));
    expect_predicted_effects(scene, s, all);
}

SI_TEST_IS(Slow, AdviceTest, ALightWithoutVisibleShadowNeedsNoMap);
TEST_F(AdviceTest, ALightWithoutVisibleShadowNeedsNoMap) {
    Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    // The camera and the light are straight above the scene, 115 m from the origin.
    const glm::dvec3 far_off(80, 0, 80);
    test::move_scene(scene, far_off);
    const Settings s = settings_for(scene, {"light.elevation=90", "camera.source=manual", "camera.elevation=90",
                                            "camera.target_x=80", "camera.target_z=80", "camera.orthographic=true"});
    const std::vector<Trial> all = advised(scene, s);
    EXPECT_TRUE(has(all, "no-shadow"));
    expect_predicted_effects(scene, s, all);
}

TEST_F(AdviceTest, AnEmptySceneIsNoProblem) {
    const Scene scene;
    const AdviceReport r = find_advice({renderer, scene, 64, 48, cache}, Settings{}, {});
    EXPECT_TRUE(r.holds.empty());
    ASSERT_FALSE(r.findings.empty());
    EXPECT_NE(r.findings[0].text.find("no pixel of the picture faces light 0"), std::string::npos);
}

TEST_F(AdviceTest, AStoppedSearchKeepsItsFindings) {
    const Scene scene = load_scene("boxes");
    std::stop_source stop;
    const Settings acne = settings_for(scene, {"bias.kind=constant", "bias.constant=0", "bias.normal=0"});
    const auto stop_later = [&](double, const std::string& what) {
        if (what != "the present settings") stop.request_stop();
    };
    const AdviceReport r =
        find_advice({renderer, scene, 64, 48, cache, {.stop = stop.get_token()}, stop_later}, acne, {});
    EXPECT_TRUE(r.stopped);
    EXPECT_FALSE(r.findings.empty());
    EXPECT_TRUE(r.holds.empty());
    EXPECT_THROW(find_advice({renderer, scene, 64, 48, cache, {.stop = stop.get_token()}}, settings_for(scene), {}),
                 Cancelled)
        << "nothing was measured";
}

/// Frames in which one thing moves draw only the passes that depend on it.
TEST_F(AdviceTest, MotionsDrawOnlyThePassesThatReadThem) {
    const Scene scene = load_scene("boxes");
    Measurer measurer(renderer, width, height);
    const auto ran = [&](const Sets& sets, CostCase cost) {
        TimedFrames frames = measurer.frames(scene, settings_for(scene, sets), cost);
        frames.warm_up();
        std::pair<int, int> maps_and_pictures{0, 0};
        for (int i = 0; i < 8; ++i)
            for (const PassInfo& pass : frames.draw_next().passes)
                if (pass.state == PassState::Drawn)
                    ++(pass.category == PassCategory::Maps ? maps_and_pictures.first : maps_and_pictures.second);
        return maps_and_pictures;
    };
    const auto forced = ran({}, CostCase::Forced), camera = ran({}, CostCase::Camera), light = ran({}, CostCase::Light);
    EXPECT_GE(forced.first, 8);
    EXPECT_GE(forced.second, 8);
    EXPECT_EQ(camera.first, 0) << "the map is cached";
    EXPECT_GE(camera.second, 8);
    EXPECT_GE(light.first, 8);
    EXPECT_GE(ran({"light.cascades=2"}, CostCase::Camera).first, 8) << "these maps follow the camera";
    EXPECT_GE(ran({"light.elevation=90"}, CostCase::Light).first, 8) << "a light at the zenith moves, too";
}

/// Errors are real and the clock counts bytes. The result lies within a tenth of the optimum over all combinations.
SI_TEST_IS(Minutes, AdviceTest, TheAutopilotComesWithinATenthOfTheOptimum);
TEST_F(AdviceTest, TheAutopilotComesWithinATenthOfTheOptimum) {
    const std::vector<SweepAxis> axes = {{"filter.kernel", {"", "hard", "pcf3", "pcf5"}},
                                         {"map.resolution", {"", "256", "512", "1024"}},
                                         {"map.format", {"", "d16"}}};
    for (const char* name : {"boxes", "teapot"}) {
        SCOPED_TRACE(name);
        const Scene scene = load_scene(name);
        const Settings s = settings_for(scene);
        TrialMeter meter = meter_by_work(scene);
        meter.ms = [&](const Settings& t) {
            return CostChange{1e-6 * double(meter.measure(t, 0).work.bytes_touched), 0};
        };
        meter.now_s = [] { return 0.0; };
        const AutopilotGoals all{.max_error = 1};
        const AutopilotResult known = run_autopilot(s, axes, all, meter);
        ASSERT_EQ(known.cases.size(), 32u);
        for (const double share : {0.25, 0.5}) {
            std::vector<double> errors;
            for (const AutopilotCase& c : known.cases) errors.push_back(c.classified.error);
            std::sort(errors.begin(), errors.end());
            const AutopilotGoals goals{.max_error = errors[std::size_t(share * 31)], .max_combinations = 16};
            double least = 1e300;
            for (const AutopilotCase& c : known.cases)
                if (c.classified.error <= *goals.max_error) least = std::min(least, meter.ms(c.settings).value);
            const AutopilotResult r = run_autopilot(s, axes, goals, meter);
            ASSERT_TRUE(r.goals_met) << r.summary;
            EXPECT_LE(*r.best.ms, 1.1 * least) << r.summary;
            EXPECT_LE(r.best.classified.error, *goals.max_error);
        }
    }
}

}  // namespace
}  // namespace si
