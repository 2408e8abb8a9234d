// Every guided preset loads without a fault and shows what its sentence says, counted against ray-traced truth.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/base/output.h"
#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/reference/error_task.h"
#include "renderer/reference/truth_picture.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/earlier.h"
#include "renderer/settings/param.h"
#include "tests/hard_cases/guided_claims.h"
#include "tests/support/guided.h"

namespace si::test {
namespace {

std::vector<const Claims*> all_claims() {
    return {&guided_surface_claims(), &guided_soft_claims(), &guided_map_claims(), &guided_moment_claims(),
            &guided_view_claims()};
}

std::vector<std::string> claimed_keys() {
    std::vector<std::string> list;
    for (const Claims* claims : all_claims())
        for (const auto& [key, claim] : *claims) list.push_back(key);
    return list;
}

std::string identifier(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

class GuidedPresets : public testing::TestWithParam<std::string> {};

TEST_P(GuidedPresets, ShowsWhatItsSentenceClaims) {
    for (const Claims* claims : all_claims())
        if (const auto it = claims->find(GetParam()); it != claims->end()) return it->second();
    FAIL() << "no claims";
}

INSTANTIATE_TEST_SUITE_P(Each, GuidedPresets, testing::ValuesIn(claimed_keys()), identifier);

TEST(GuidedPresetFiles, EachHasATextATopicASceneAndACountedClaim) {
    std::vector<std::string> keys, claimed = claimed_keys();
    std::set<std::string> titles, abouts, topics;
    std::string topic;
    for (const BuiltinPreset& p : builtin_presets()) {
        keys.push_back(p.key);
        EXPECT_TRUE(titles.insert(p.title).second && !p.title.empty()) << p.key << ": " << p.title;
        EXPECT_TRUE(abouts.insert(p.about).second) << p.key;
        EXPECT_GT(p.about.size(), 60u) << p.key;
        EXPECT_LT(p.about.size(), 330u) << p.key << ": longer than a glance";
        EXPECT_EQ(p.about.back(), '.') << p.key;
        if (p.topic != topic) {
            EXPECT_TRUE(topics.insert(p.topic).second) << p.key << ": the topic " << p.topic << " is torn apart";
        }
        topic = p.topic;
        const auto scenes = builtin_scenes();
        EXPECT_TRUE(std::any_of(scenes.begin(), scenes.end(), [&](const BuiltinScene& s) { return s.key == p.scene; }))
            << p.key;
    }
    std::sort(keys.begin(), keys.end());
    std::sort(claimed.begin(), claimed.end());
    EXPECT_EQ(keys, claimed) << "a preset without a counted claim, or a claim without a preset";
    EXPECT_GE(keys.size(), 30u);
}

TEST(GuidedPresetFiles, OpenWithoutRemarksButForTheCastersTheyLose) {
    for (const BuiltinPreset& p : builtin_presets()) {
        SCOPED_TRACE(p.key);
        const Session session = open_session({.scene = {}, .preset = p.key, .sets = {}});
        EXPECT_TRUE(session.notes.empty()) << session.notes.front();
        FrameRequest request;
        request.width = 64;
        request.height = 36;
        request.outputs.health = true;
        ReferenceCache references;  // what is baked or traced for a picture is there when it is shown
        trace_sources(hard_renderer(), session.scene, session.settings, request, references);
        const FrameResult frame = hard_renderer().render(session.scene, session.settings, request);
        const auto health = hard_renderer().numeric_health(frame);
        EXPECT_TRUE(health->sound()) << health_text(*health);
        for (const std::string& note : frame.notes)
            EXPECT_TRUE((p.topic == "Front-face culling" && note.find("casts no shadow") != std::string::npos) ||
                        (p.key == "full-page-pool" && note.find("map.page_pool") != std::string::npos))
                << note;
        for (const SettingRef& ref : changed_settings(session.settings))
            EXPECT_EQ(idle_reason(session.settings, ref), "") << setting_key(ref);
    }
}

TEST(GuidedPresetFiles, AreWrittenAsTheProgramWritesThem) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SI_SOURCE_DIR) / "assets/presets")) {
        // Those of version 1 stay as they are, so that every use of one shows that such files are read.
        const std::string text = read_text_file(entry.path());
        auto written = nlohmann::ordered_json::parse(preset_text(parse_preset(text, entry.path().string())));
        const auto file = nlohmann::ordered_json::parse(text);
        if (file["version"] < kSettingsVersion) {
            written["version"] = file["version"];
            for (const SettingRef& ref : changed_settings(defaults_of_version(file["version"])))
                if (!file["settings"].contains(setting_key(ref))) written["settings"].erase(setting_key(ref));
        }
        EXPECT_EQ(written.dump(2) + "\n", text) << entry.path();
    }
}

}  // namespace
}  // namespace si::test
