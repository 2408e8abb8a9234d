// Tests of sweep axes: for every setting an axis gives the settings and scene, or the error, of --set.
#include "app/sweep/case_sessions.h"

#include <gtest/gtest.h>

#include <functional>

#include "app/sweep/spec.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/support/traits.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

/// Makes two scenes. 0: a triangle and two cameras. 1: two triangles, an animated spot light, one camera.
std::string two_scenes() {
    test::GltfFile f;
    f.json["extensionsUsed"] = {"KHR_lights_punctual"};
    f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"range", 30.0}}};
    const int mesh = f.mesh({{"attributes", {{"POSITION", f.triangle_positions()}}}});
    const int camera = f.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    f.root({{"name", "First"}, {"mesh", mesh}});
    for (const double z : {3.0, 4.0}) f.root({{"camera", camera}, {"translation", {0, 0, z}}});
    const int second = f.append("nodes", {{"name", "Second"}, {"mesh", mesh}});
    const int third = f.append("nodes", {{"name", "Third"}, {"mesh", mesh}, {"translation", {0, 0, -1}}});
    const int lamp = f.append(
        "nodes",
        {{"name", "Lamp"}, {"translation", {0, 5, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const int eye = f.append("nodes", {{"camera", camera}, {"translation", {0, 0, 6}}});
    f.json["scenes"].push_back({{"nodes", {second, third, lamp, eye}}});
    const int times = f.floats({0, 2}, "SCALAR"), places = f.floats({0, 5, 0, 4, 5, 0}, "VEC3");
    f.append("animations", {{"samplers", {{{"input", times}, {"output", places}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", lamp}, {"path", "translation"}}}}}}});
    return f.glb();
}

struct Outcome {
    std::string error;
    Settings settings;
    std::uint64_t content = 0;
    std::vector<std::string> notes;
};

Outcome outcome_of(const std::function<void(Outcome&)>& way) {
    Outcome out;
    try {
        way(out);
    } catch (const std::exception& e) {
        out = {};
        out.error = e.what();
    }
    return out;
}

class CaseSessionsTest : public testing::Test {
protected:
    test::TemporaryFolder folder;
    std::string file = folder.write("two.glb", two_scenes()).string();

    /// Expects the same session from a command line with these sets and from a sweep with them as axes of one value.
    void expect_same(const std::string& scene, const std::vector<std::string>& sets) {
        std::string what = scene;
        for (const std::string& s : sets) what += " " + s;
        const Outcome set = outcome_of([&](Outcome& out) {
            const Session session = open_session({.scene = scene, .preset = {}, .sets = sets});
            out.settings = session.settings;
            out.content = scene_content_key(session.scene);
            out.notes = session.notes;
        });
        const Outcome axis = outcome_of([&](Outcome& out) {
            std::vector<SweepAxis> axes;
            for (const std::string& s : sets) axes.push_back(parse_axis(s));
            const SessionPlan opened = plan_session({.scene = scene, .preset = {}, .sets = {}});
            Session base = compose_session(opened, load_scene(scene, scene_options(opened)));
            const SweepPlan plan = plan_sweep(measured_settings(base.settings), axes);
            CaseSessions sessions(opened);
            sessions.add_scene(std::move(base.scene), base.settings.scene);
            sessions.check(axes);
            const auto prepared = sessions.prepare(plan.cases.at(0).sets());
            out.settings = prepared.settings;
            out.content = scene_content_key(prepared.scene);
            out.notes = prepared.notes;
        });
        EXPECT_EQ(axis.error, set.error) << what;
        EXPECT_TRUE(axis.settings == set.settings) << what;
        EXPECT_EQ(axis.content, set.content) << what;
        for (const std::string& note : axis.notes)
            EXPECT_NE(std::find(set.notes.begin(), set.notes.end(), note), set.notes.end()) << what << ": " << note;
        refused += !set.error.empty();
    }
    int refused = 0;
};

/// Returns values to try: both ends, a middle one, and an invalid one.
std::vector<std::string> texts_of(const Param& p, const Value& like) {
    std::vector<std::string> texts = {"nonsense"};
    if (p.choices) {
        for (const Choice& c : p.choices()) texts.emplace_back(c.key);
    } else if (std::holds_alternative<bool>(like)) {
        texts.insert(texts.end(), {"true", "off", "2"});
    } else {
        const bool whole = std::holds_alternative<int>(like);
        for (const double v : {p.min, p.max, p.min + 1, p.max + 1})
            texts.push_back(value_text(p, whole ? Value(int(v)) : Value(v)));
        texts.push_back("0.5");
    }
    return texts;
}

SI_TEST_IS(Repeated, CaseSessionsTest, AxisEqualsSetForEverySetting);
TEST_F(CaseSessionsTest, AxisEqualsSetForEverySetting) {
    for (const Param& p : params()) {
        if (is_text(p)) continue;  // names are no axis
        std::vector<std::string> keys = {std::string(p.key)};
        if (p.scope == Scope::Light) keys.push_back("light.1." + std::string(p.key.substr(6)));
        if (p.scope == Scope::Object)
            keys = {"object.First." + std::string(p.key.substr(7)), "object.Nowhere." + std::string(p.key.substr(7))};
        for (const std::string& key : keys)
            for (const std::string& text : texts_of(p, default_value(*find_setting(key)))) {
                expect_same(file, {key + "=" + text});
                if (p.scope != Scope::Light) expect_same("boxes", {key + "=" + text});
            }
    }
    EXPECT_GT(refused, 100) << "of values that are none";
}

TEST_F(CaseSessionsTest, ObjectsMissingInTheSceneAreRefusedLikeSet) {
    expect_same("boxes", {"camera.index=9999"});
    expect_same(file, {"camera.index=1"});
    expect_same(file, {"scene.index=1", "camera.index=1"});
    expect_same(file, {"camera.index=1", "scene.index=0"});
    expect_same(file, {"scene.index=2"});
    expect_same(file, {"scene.index=1", "scene.animation=1"});
    expect_same(file, {"scene.index=1", "scene.time=1.5"});
    expect_same(file, {"scene.index=1", "light.azimuth=10", "scene.time=2"});
    expect_same(file, {"camera.source=manual", "camera.index=7"});
    expect_same(file, {"scene.index=1", "object.First.cast=false"});
    expect_same(file, {"light.fit=manual", "light.near=50", "light.far=5"});
}

TEST_F(CaseSessionsTest, EachSceneOfAFileIsSeparate) {
    const SessionPlan opened = plan_session({.scene = file, .preset = {}, .sets = {}});
    CaseSessions sessions(opened);
    const auto triangles = [&](const char* index) {
        const auto p = sessions.prepare({{"scene.index", index}});
        return std::pair(p.scene.triangle_count(), p.settings.lights[0].type);
    };
    EXPECT_EQ(triangles("0"), std::pair(std::size_t(1), LightType::Directional));
    EXPECT_EQ(triangles("1"), std::pair(std::size_t(2), LightType::Spot)) << "the scene's own light is suggested";
    EXPECT_EQ(triangles("0").first, 1u);
    // The light moves by 4 m in 2 s; the suggestion follows.
    const auto target = [&](const char* time) {
        return sessions.prepare({{"scene.index", "1"}, {"scene.time", time}}).settings.lights[0].target_x;
    };
    EXPECT_NE(target("0"), target("2"));
}

TEST_F(CaseSessionsTest, OrderOfValuesDoesNotHideRefusals) {
    const SessionPlan opened = plan_session({.scene = "boxes", .preset = {}, .sets = {}});
    CaseSessions sessions(opened);
    EXPECT_NO_THROW(sessions.check({parse_axis("camera.index=0,-1")}));
    EXPECT_THROW(sessions.check({parse_axis("camera.index=0,9999")}), UsageError);
    EXPECT_THROW(sessions.check({parse_axis("object.Nowhere.cast=true,false")}), UsageError);
    EXPECT_THROW(sessions.check({parse_axis("camera.source=manual"), parse_axis("camera.index=-1,9999")}), UsageError);
}

}  // namespace
}  // namespace si
