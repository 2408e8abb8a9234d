// Tests of `preset diff`: files, built-in presets and the defaults, in words and as JSON.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

class PresetDiffCommand : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fresh_test_folder();
        ASSERT_EQ(run({"preset", "save", "boxes", "-o", "a.json", "--set", "bias.constant=0.5"}).code, 0);
        ASSERT_EQ(run({"preset", "save", "boxes", "-o", "b.json", "--set", "bias.constant=0", "--title", "B", "--topic",
                       "Tests", "--about", "Look."})
                      .code,
                  0);
    }
    ProcessResult run(const std::vector<std::string>& arguments) const { return run_program(arguments, folder_); }

    std::filesystem::path folder_;
};

TEST_F(PresetDiffCommand, PrintsDifferencesInWords) {
    const ProcessResult r = run({"preset", "diff", "a.json", "b.json"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, "a.json → b.json: 1 difference\nBias\n  bias.constant: 0.5 → 0 texels (Constant bias)\n");
    EXPECT_EQ(run({"preset", "diff", "a.json", "a.json"}).out, "a.json and a.json are equal\n");
}

TEST_F(PresetDiffCommand, ComparesWithTheDefaults) {
    const std::string text = run({"preset", "diff", "default", "a.json"}).out;
    EXPECT_NE(text.find("Scene\n  scene: any → boxes\n"), std::string::npos) << text;
    EXPECT_NE(text.find("bias.constant: 0.1 → 0.5 texels (Constant bias)"), std::string::npos) << text;
    EXPECT_NE(text.find("light.azimuth: -40° → -52° (Azimuth)"), std::string::npos) << text;
    EXPECT_EQ(run({"preset", "diff", "default", "default"}).out, "default and default are equal\n");
}

TEST_F(PresetDiffCommand, GivesJsonForScripts) {
    const auto json = nlohmann::json::parse(run({"preset", "diff", "a.json", "b.json", "--json"}).out);
    EXPECT_EQ(json["equal"], false);
    ASSERT_EQ(json["differences"].size(), 1u);
    const auto& row = json["differences"][0];
    EXPECT_EQ(row["key"], "bias.constant");
    EXPECT_EQ(row["before"], 0.5);
    EXPECT_EQ(row["after"], 0);
    EXPECT_EQ(row["group"], "Bias");
    EXPECT_EQ(row["without_effect"], "");
    EXPECT_EQ(nlohmann::json::parse(run({"preset", "diff", "a.json", "a.json", "--json"}).out)["equal"], true);
}

TEST_F(PresetDiffCommand, RefusesUnreadableFiles) {
    std::ofstream(folder_ / "bad.json") << "{";
    for (const char* bad : {"bad.json", "missing.json", "no-such-preset"}) {
        const ProcessResult r = run({"preset", "diff", "a.json", bad});
        EXPECT_EQ(r.code, std::string(bad).ends_with(".json") ? 1 : 2) << bad;
        EXPECT_NE(r.err.find(bad), std::string::npos) << r.err;
        EXPECT_EQ(r.out, "") << bad;
    }
    EXPECT_EQ(run({"preset", "diff", "a.json"}).code, 2);
}

TEST_F(PresetDiffCommand, PrintsTitleAndTopic) {
    const ProcessResult r = run({"preset", "show", "b.json"});
    EXPECT_EQ(r.out.substr(0, r.out.find("scene ")), "Tests: B\nLook.\n");
}

}  // namespace
}  // namespace si
