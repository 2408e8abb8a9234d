// Tests of presets: written ones are read back; wrong ones are refused with file, place and fix.
#include "app/session/presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/base/output.h"
#include "renderer/base/error.h"
#include "renderer/settings/earlier.h"
#include "renderer/settings/param.h"
#include "tests/support/error_text.h"
#include "tests/support/process.h"
#include "tests/support/sets.h"

namespace si {
namespace {

namespace fs = std::filesystem;

std::string with_settings(const std::string& settings) {
    return R"({"format":"shadow-inspector-preset","version":3,"settings":{)" + settings + "}}";
}

std::string refusal(const std::string& json) {
    try {
        parse_preset(json, "dir/a.json");
    } catch (const UsageError&) {
        ADD_FAILURE() << "a bad file is no usage error";
    } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "one line";
        return e.what();
    }
    return {};
}

Preset sample() {
    Preset p;
    p.about = "What to look at: \"edges\"";
    p.scene = "stage";
    set_all(p.settings, {"bias.slope=0.1", "filter.kernel=hard", "light.2.azimuth=-33.25", "map.reversed_z=true",
                         "map.resolution=1024", "object.Root/Leaves.v1.2.cull=front"});
    return p;
}

/// Makes a preset with these claims.
std::string with_claims(const std::string& list) {
    return R"({"format":"shadow-inspector-preset","version":3,"settings":{},"claims":)" + list + "}";
}

class PresetFiles : public testing::Test {
protected:
    const fs::path folder_ = fresh_test_folder();
};

TEST(Presets, RoundTripThroughText) {
    const Preset p = sample();
    const std::string text = preset_text(p);
    const Preset back = parse_preset(text, "a.json");
    EXPECT_EQ(back.settings, p.settings);
    EXPECT_EQ(back.about, p.about);
    EXPECT_EQ(back.scene, p.scene);
    EXPECT_EQ(preset_text(back), text);
}

TEST(Presets, BuiltInPresetsKeepTheirClaims) {
    const std::string list =
        R"([{"metric":"mae","op":"<","times":0.5,"than":{"set":["filter.kernel=hard"]}},{"metric":"acne","op":"==","value":0}])";
    const Preset preset = parse_preset(with_claims(list), "a.json");
    ASSERT_EQ(preset.claims.size(), 2u);
    EXPECT_EQ(preset.claims[0].times, 0.5);
    EXPECT_EQ(preset.claims[0].than->metric, "mae") << "has what it does not name from the claim";
    EXPECT_EQ(preset.claims[0].than->set, std::vector<std::string>{"filter.kernel=hard"});
    EXPECT_FALSE(preset.claims[1].than);
    EXPECT_EQ(nlohmann::json::parse(preset_text(preset))["claims"], nlohmann::json::parse(list));
    EXPECT_EQ(preset_text(parse_preset(preset_text(preset), "b.json")), preset_text(preset));
}

TEST(Presets, HoldOnlyDifferencesWithChoicesByKey) {
    const auto json = nlohmann::json::parse(preset_text(sample()));
    EXPECT_EQ(json["format"], "shadow-inspector-preset");
    EXPECT_EQ(json["version"], kSettingsVersion);
    EXPECT_EQ(json["settings"].size(), 6u);
    EXPECT_EQ(json["settings"]["filter.kernel"], "hard");
    EXPECT_EQ(json["settings"]["map.reversed_z"], true);
    EXPECT_EQ(json["settings"]["map.resolution"], 1024);
    EXPECT_EQ(json["settings"]["object.Root/Leaves.v1.2.cull"], "front");
    EXPECT_TRUE(nlohmann::json::parse(preset_text(Preset{}))["settings"].empty());
}

TEST(Presets, WrongSettingsAreRefusedWithAFix) {
    EXPECT_EQ(refusal(with_settings(R"("bias.slop":1)")),
              "dir/a.json: settings.\"bias.slop\": unknown setting; did you mean bias.slope?");
    const struct {
        const char *setting, *mentions;
    } cases[] = {
        {R"("bias.slope":"much")", "settings.\"bias.slope\": wrong type: a number is wanted"},
        {R"("bias.slope":2000)", "0 to 1000"},
        {R"("bias.slope":null)", "wrong type"},
        {R"("bias.slope":true)", "wrong type"},
        {R"("map.resolution":1024.5)", "whole number"},
        {R"("map.resolution":1e300)", "1 to 16384"},
        {R"("map.resolution":99999999999999999999999)", "1 to 16384"},
        {R"("map.format":2)", "wrong type: one of its choices"},
        {R"("map.format":"d23")", "did you mean d24?"},
        {R"("map.reversed_z":1)", "true or false"},
        {R"("light.16.azimuth":1)", "did you mean light.15.azimuth?"},
        {R"("object.Floor.cul":"none")", "did you mean object.Floor.cull?"},
        {R"("bias.slope":1,"bias.slope":2)", "\"bias.slope\" occurs twice"},
        {R"("light.azimuth":1,"light.0.azimuth":2)", "the same setting as \"light.azimuth\""},
        {R"("bias.slope":1e999)", "line 1, column 74: 1e999 is beyond the range"},
    };
    for (const auto& c : cases) {
        const std::string message = refusal(with_settings(c.setting));
        EXPECT_TRUE(message.starts_with("dir/a.json: ")) << message;
        EXPECT_NE(message.find(c.mentions), std::string::npos) << c.setting << " -> " << message;
    }
}

TEST(Presets, WrongFilesAreRefusedWithThePlace) {
    const struct {
        std::string text, mentions;
    } cases[] = {
        {"", "line 1, column 1: not JSON"},
        {"{\n  \"format\": \"shadow-inspector-preset\",\n  \"version\": 3,,\n}", "line 3, column 16: not JSON"},
        {"[]", "not a preset"},
        {"{}", "\"format\" must be"},
        {R"({"format":"other","version":3,"settings":{}})", "\"format\" must be"},
        {R"({"format":"shadow-inspector-preset","version":4,"settings":{}})",
         "\"version\" is 4, but this program reads versions 2 to 3: a newer one wrote the file"},
        {R"({"format":"shadow-inspector-preset","version":0,"settings":{}})",
         "\"version\" is 0, but this program reads versions 2 to 3"},
        {R"({"format":"shadow-inspector-preset","version":"1","settings":{}})", "\"version\" is \"1\""},
        {R"({"format":"shadow-inspector-preset","version":1.5,"settings":{}})", "\"version\" is 1.5"},
        {R"({"format":"shadow-inspector-preset","settings":{}})", "\"version\" is missing"},
        {R"({"format":"shadow-inspector-preset","version":3})", "\"settings\" must be an object"},
        {R"({"format":"shadow-inspector-preset","version":3,"settings":[]})", "\"settings\" must be an object"},
        {R"({"format":"shadow-inspector-preset","version":3,"settings":{},"about":3})", "\"about\" must be a text"},
        {R"({"format":"shadow-inspector-preset","version":3,"settings":{},"abuot":""})", "did you mean \"about\"?"},
        {with_claims("3"), "claims: must be an array"},
        {with_claims("[3]"), "claims[0]: must be an object"},
        {with_claims(R"([{"op":"<"}])"), "claims[0]: names no \"metric\""},
        {with_claims(R"([{"metric":3,"op":"<"}])"), "claims[0].metric: has the wrong type"},
        {with_claims(R"([{"metric":"mae","op":"=<"}])"), "claims[0].op: must be one of <, <=, ==, >=, >"},
        {with_claims(R"([{"metric":"mae","op":"<"},{"metrik":"mae"}])"),
         "claims[1].metrik: unknown member; did you mean metric?"},
        {with_claims(R"([{"metric":"mae","op":"<","set":"a=1"}])"), "claims[0].set: has the wrong type"},
        {with_claims(R"([{"metric":"mae","op":"<","size":[3]}])"), "claims[0].size: must be [width, height]"},
        {with_claims(R"([{"metric":"mae","op":"<","size":[1e300,3]}])"), "of 1 to 4096 pixels"},
        {with_claims(R"([{"metric":"mae","op":"<","than":{"op":"<"}}])"), "claims[0].than.op: unknown member"},
        {"{\"format\":\"\xff\"}", "not JSON"},
        {std::string(200000, '['), "it nests 200000 levels deep, at most 32 are read"},
        {std::string("{}\0", 3), "line 1, column 3: not JSON: a NUL character"},
    };
    for (const auto& c : cases) {
        const std::string message = refusal(c.text);
        EXPECT_TRUE(message.starts_with("dir/a.json: ")) << message;
        EXPECT_NE(message.find(c.mentions), std::string::npos) << c.text.substr(0, 80) << " -> " << message;
    }
}

TEST_F(PresetFiles, AreSavedAndLoaded) {
    const fs::path path = folder_ / "a.json";
    save_preset(Preset{}, path);
    save_preset(sample(), path);
    EXPECT_EQ(load_preset(path.string()).settings, sample().settings);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "no temporary is left";
}

TEST_F(PresetFiles, ErrorsNameTheFile) {
    EXPECT_TRUE(test::fails_with([&] { save_preset(sample(), folder_); }, {"is a directory"}));
    EXPECT_TRUE(test::fails_with([&] { save_preset(sample(), folder_ / "no" / "a.json"); }, {"does not exist"}));
    EXPECT_TRUE(test::fails_with([&] { load_preset((folder_ / "b.json").string()); }, {"b.json: no such file"}));
    EXPECT_TRUE(test::fails_with([&] { load_preset(folder_.string()); }, {"is not a file"}));
}

TEST_F(PresetFiles, KeepABundleThatDoesNotExist) {
    const fs::path path = folder_ / "a.json", bundle = "no such folder/a.bundle";
    Preset preset;
    preset.settings.map.bundle = bundle.string();
    save_preset(preset, path);
    const std::string read = load_preset(path.string()).settings.map.bundle;
    ASSERT_NE(read, "");
    EXPECT_EQ(fs::weakly_canonical(fs::absolute(read)), fs::weakly_canonical(fs::absolute(bundle)));
}

TEST_F(PresetFiles, LinkStaysALink) {
    const fs::path real = folder_ / "real.json", link = folder_ / "link.json";
    save_preset(Preset{}, real);
    fs::create_symlink(real, link);
    save_preset(sample(), link);
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(load_preset(real.string()).settings, sample().settings);
}

TEST(Presets, BuiltInPresetsAreValidAndInFileOrder) {
    const auto list = builtin_presets();  // parses them all
    // The number before a file's name orders it and is no part of its key.
    std::vector<std::string> files, keys;
    for (const auto& entry : fs::directory_iterator(fs::path(SI_SOURCE_DIR) / "assets/presets"))
        files.push_back(entry.path().stem().string());
    std::sort(files.begin(), files.end());
    for (std::string& file : files) file.erase(0, file.find('-') + 1);
    for (const BuiltinPreset& p : list) keys.push_back(p.key);
    EXPECT_EQ(keys, files);
    for (const auto& preset : list) {
        EXPECT_FALSE(preset.about.empty()) << preset.key;
        EXPECT_NO_THROW(load_preset(preset.key));
    }
}

}  // namespace
}  // namespace si
