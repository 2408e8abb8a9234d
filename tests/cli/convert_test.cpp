// Tests of the command `convert`: targets, output files, wrong uses, scenes and hostile titles.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/convert/targets.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

class ConvertCommand : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(run(Words("preset save boxes -o p.json --set bias.kind=constant --set bias.constant=1.5 --set "
                            "bias.normal=1 --set light.extent=10 --set light.near_far=manual --set light.near=0 --set "
                            "light.far=40 --set filter.kernel=hard"))
                      .code,
                  0);
    }
    ProcessResult run(const Words& arguments) const { return run_program(arguments, folder_); }

    const fs::path folder_ = fresh_test_folder();
};

TEST_F(ConvertCommand, WritesEveryTarget) {
    for (const ConvertTarget& target : convert_targets()) {
        const ProcessResult r = run({"convert", "p.json", "--to", std::string(target.name), "--no-scene"});
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(
            test::lacking(r.out, {"preset p.json", "W 20 m, N 2048 texels, D 40 m", "reference angle 45 degrees"}), "");
        const auto json =
            program_json({"convert", "p.json", "--to", std::string(target.name), "--no-scene", "--json"}, folder_);
        EXPECT_EQ(json["target"], target.name);
        EXPECT_NE(r.out.find(json["code"].get<std::string>()), std::string::npos);
    }
}

SI_TEST_IS(Later, ConvertCommand, MeasuresTheScene);
TEST_F(ConvertCommand, MeasuresTheScene) {
    const Words boxes = "convert p.json --to three --size 96x54 --no-time --json";
    const auto json = program_json(boxes, folder_);
    EXPECT_EQ(json["measured"]["area"], false);
    EXPECT_EQ(json["measured"]["frame_ms"], nullptr);
    const auto measured = program_json("measure boxes --preset p.json --size 96x54 --no-time --json", folder_)["error"];
    EXPECT_EQ(json["measured"]["mae"], measured["mae"]);
    EXPECT_EQ(json["measured"]["acne_px"], measured["artefacts"]["acne"]);
    EXPECT_GT(json["angle_deg"].get<double>(), 1);
    EXPECT_LT(json["angle_deg"].get<double>(), 89.5);
    EXPECT_NE(program_json(boxes + "--angle 30", folder_)["angle_deg"], json["angle_deg"]);
    EXPECT_EQ(program_json(boxes + "--angle 30", folder_)["angle_deg"], 30);
    EXPECT_EQ(program_json(boxes + "--area", folder_)["measured"]["area"], true);
    const ProcessResult text = run("convert p.json --to cpp --size 96x54");
    EXPECT_EQ(test::lacking(text.out, {"measured on boxes at 96x54 against a hard reference", " ms a frame ("}), "");
}

TEST_F(ConvertCommand, RefusesWrongUses) {
    expect_error("convert p.json --to tree --no-scene", 2, "did you mean three?", folder_);
    expect_error("convert p.json", 2, "--to", folder_);
    expect_error("convert p.json --to three -o p.json --no-scene", 2, "p.json", folder_);
    EXPECT_EQ(run("preset check p.json").code, 0) << "the preset was overwritten";
    fs::create_symlink("p.json", folder_ / "link.js");
    expect_error("convert p.json --to three -o link.js --no-scene", 2, "link.js", folder_);
    expect_error("convert p.json --to three -o missing/a.js --no-scene", 1, "missing", folder_);
    expect_error("convert none.json --to three", 1, "none.json", folder_);
    expect_error("convert p.json --to glsl --no-scene --set light.source=volumes-zfail", 1, "set light.source to map",
                 folder_);
    expect_error("convert p.json --to glsl --no-scene --set view.light=9", 1, "the lights are 0 to 0", folder_);
    expect_error("convert p.json --to three --set view.light=9", 1, "the lights are 0 to 0", folder_);
    expect_error("convert p.json --to three --angle 90 --no-scene", 2, "--angle", folder_);
    expect_error("convert p.json --to three --scene no-such-scene", 2, "no-such-scene", folder_);
}

TEST_F(ConvertCommand, WritesAFileWholly) {
    const ProcessResult r = run("convert p.json --to godot -o out.gd --no-scene");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, "wrote out.gd\n");
    EXPECT_EQ(file_bytes(folder_ / "out.gd"), run("convert p.json --to godot --no-scene").out);
}

TEST_F(ConvertCommand, HostileTitlesStayInTheirComment) {
    std::ofstream(folder_ / "h.json") << R"({"format": "shadow-inspector-preset", "version": 1})";
    nlohmann::json preset = nlohmann::json::parse(file_bytes(folder_ / "p.json"));
    preset["title"] =
        "a */ evil(); // \\ \xe2\x80\xa8 evil(); ?"
        "?/ <script>";
    std::ofstream(folder_ / "h.json") << preset.dump();
    const ProcessResult plain = run("convert p.json --to three --no-scene");
    const ProcessResult hostile = run("convert h.json --to three --no-scene");
    ASSERT_EQ(hostile.code, 0) << hostile.err;
    EXPECT_EQ(hostile.out.substr(hostile.out.find("\n\n")), plain.out.substr(plain.out.find("\n\n")));
    const std::string head = hostile.out.substr(0, hostile.out.find("\n\n"));
    EXPECT_EQ(head.find("*/"), std::string::npos);
    EXPECT_EQ(head.find("\xe2\x80\xa8"), std::string::npos);
}

}  // namespace
}  // namespace si
