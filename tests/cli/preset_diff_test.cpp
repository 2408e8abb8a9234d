// Tests of `preset diff`: files, built-in presets and the defaults, in words and as JSON.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/text.h"

namespace si {
namespace {

class PresetDiffCommand : public testing::Test {
protected:
    void SetUp() override {
        for (const char* preset : {"-o a.json --set bias.kind=constant --set bias.normal=0 --set bias.constant=0.5",
                                   "-o b.json --set bias.kind=constant --set bias.normal=0 --set bias.constant=0 "
                                   "--title B --topic Tests --about Look."})
            ASSERT_EQ(run(Words("preset save boxes") + preset).code, 0) << preset;
    }
    ProcessResult run(const Words& arguments) const { return run_program(arguments, folder_); }

    const std::filesystem::path folder_ = fresh_test_folder();
};

TEST_F(PresetDiffCommand, PrintsDifferencesInWords) {
    const ProcessResult r = run("preset diff a.json b.json");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, "a.json → b.json: 1 difference\nBias\n  bias.constant: 0.5 → 0 texels (Constant bias)\n");
    EXPECT_EQ(run("preset diff a.json a.json").out, "a.json and a.json are equal\n");
}

TEST_F(PresetDiffCommand, ComparesWithTheDefaults) {
    EXPECT_EQ(test::lacking(run("preset diff default a.json").out,
                            {"Scene\n  scene: any → boxes\n", "bias.constant: 0 → 0.5 texels (Constant bias)",
                             "light.azimuth: -40° → -52° (Azimuth)"}),
              "");
    EXPECT_EQ(run("preset diff default default").out, "default and default are equal\n");
}

TEST_F(PresetDiffCommand, GivesJsonForScripts) {
    const auto json = program_json("preset diff a.json b.json", folder_);
    EXPECT_EQ(json["equal"], false);
    ASSERT_EQ(json["differences"].size(), 1u);
    const auto& row = json["differences"][0];
    EXPECT_EQ(row["key"], "bias.constant");
    EXPECT_EQ(row["before"], 0.5);
    EXPECT_EQ(row["after"], 0);
    EXPECT_EQ(row["group"], "Bias");
    EXPECT_EQ(row["without_effect"], "");
    EXPECT_EQ(program_json("preset diff a.json a.json", folder_)["equal"], true);
}

TEST_F(PresetDiffCommand, RefusesUnreadableFiles) {
    std::ofstream(folder_ / "bad.json") << "{";
    for (const char* bad : {"bad.json", "missing.json", "no-such-preset"}) {
        const int code = std::string(bad).ends_with(".json") ? 1 : 2;
        EXPECT_EQ(expect_error({"preset", "diff", "a.json", bad}, code, bad, folder_).out, "") << bad;
    }
    EXPECT_EQ(run("preset diff a.json").code, 2);
}

TEST_F(PresetDiffCommand, PrintsTitleAndTopic) {
    const ProcessResult r = run("preset show b.json");
    EXPECT_EQ(r.out.substr(0, r.out.find("scene ")), "Tests: B\nLook.\n");
}

}  // namespace
}  // namespace si
