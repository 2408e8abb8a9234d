// Tests of sweep --along and --day: numbers of each point, files, the worst step as a preset, mistakes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/number_at.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

SI_TEST_IS(Later, LightPathCommand, EachStepIsMeasuredAsByItsSettings);
TEST(LightPathCommand, EachStepIsMeasuredAsByItsSettings) {
    const fs::path folder = fresh_test_folder();
    const ProcessResult r = run_program(
        "sweep boxes --set map.resolution=256 --along light.azimuth=0:60,light.elevation=20:50 --steps 3 --size 96x64 "
        "--no-time --worst-preset worst.json -o out",
        folder);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("wrote worst.json"), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("path.html"), std::string::npos) << r.out;
    const OrderedJson json = OrderedJson::parse(file_bytes(folder / "out/path.json"));
    EXPECT_EQ(json["format"], "shadow-inspector-light-path");
    ASSERT_EQ(json["steps"].size(), 3u);
    double most = 0;
    for (const OrderedJson& step : json["steps"]) {
        const auto m = program_json(Words("measure boxes --set map.resolution=256 --no-time --size 96x64") +
                                        set_words(nlohmann::json(step["settings"])),
                                    folder);
        EXPECT_EQ(number_at(step, "error.mae"), m["error"]["mae"].get<double>()) << step["settings"];
        most = std::max(most, number_at(step, "error.mae"));
    }
    EXPECT_EQ(json["steps"][1]["settings"]["light.azimuth"], "30");
    EXPECT_EQ(json["steps"][1]["settings"]["light.elevation"], "35");
    EXPECT_TRUE(json["steps"][0]["shimmer"].is_null());
    EXPECT_GT(number_at(json["steps"][1], "shimmer.change"), 0);
    EXPECT_GE(number_at(json["steps"][1], "shimmer.change"), number_at(json["steps"][1], "shimmer.beyond"));
    EXPECT_EQ(json["worst"]["value"].get<double>(), most);
    // The preset of the worst step draws the worst step.
    const auto worst = program_json("measure boxes --preset worst.json --no-time --size 96x64", folder);
    EXPECT_EQ(worst["error"]["mae"].get<double>(), most);
    const std::string csv = file_bytes(folder / "out/path.csv");
    EXPECT_TRUE(csv.starts_with("step,light.azimuth,light.elevation,hour,error.mae,")) << csv.substr(0, 80);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
    const std::string html = file_bytes(folder / "out/path.html");
    EXPECT_NE(html.find("Shimmer: change of visibility"), std::string::npos);
    EXPECT_NE(html.find("data:image/png;base64,"), std::string::npos);
    EXPECT_EQ(html.find("<script"), std::string::npos);
}

TEST(LightPathCommand, ADayGoesFromEastToWestAndIsTimed) {
    const fs::path folder = fresh_test_folder();
    const ProcessResult r = run_program("sweep boxes --day 48,172 --steps 3 --size 64x48 -o out", folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const OrderedJson json = OrderedJson::parse(file_bytes(folder / "out/path.json"));
    ASSERT_EQ(json["steps"].size(), 3u);
    EXPECT_EQ(json["steps"][1]["hour"], 12.0);
    EXPECT_EQ(json["steps"][1]["settings"]["light.azimuth"], "0") << "noon is in the south";
    EXPECT_GT(std::stod(json["steps"][0]["settings"]["light.azimuth"].get<std::string>()), 45);
    EXPECT_LT(std::stod(json["steps"][2]["settings"]["light.azimuth"].get<std::string>()), -45);
    for (const OrderedJson& step : json["steps"]) EXPECT_GT(number_at(step, "time.total_ms.median"), 0);
    EXPECT_NE(json["clock"], "");
}

TEST(LightPathCommand, TheCommandOfThePageNamesTheError) {
    const fs::path folder = fresh_test_folder();
    const std::string path = "sweep boxes --along light.azimuth=0:9 --steps 2 --size 32x24 ";
    for (const auto& [options, shown] :
         {std::pair{"--no-time", "--size 32x24 --no-time -o 'out'"},
          {"--error rmse --no-time", "--size 32x24 --error 'rmse' --no-time -o 'out'"}}) {
        const ProcessResult r = run_program(Words(path + options + " -o out"), folder);
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_NE(file_bytes(folder / "out/path.html").find(shown), std::string::npos) << options;
    }
}

TEST(LightPathCommand, MistakesAreNamedAndWriteNothing) {
    const fs::path folder = fresh_test_folder();
    expect_error("sweep boxes -o out", 2, "--vary is required", folder);
    expect_error("sweep boxes --along light.azimuth=0:9 --vary bias.slope=1 -o out", 2, "--vary", folder);
    expect_error("sweep boxes --along light.azimuth=0:9 --day 48,172 -o out", 2, "--day", folder);
    expect_error("sweep boxes --along light.azimuth=0:9 --shard 1/2 -o out", 2, "--shard", folder);
    for (const std::string option : {"--retry", "--fresh", "--rounds 3", "--frames 3"}) {
        const std::string name = option.substr(0, option.find(' ')), words = option + " -o out";
        expect_error("sweep boxes --along light.azimuth=0:9 " + words, 2, name, folder);
        expect_error("sweep boxes --day 48,172 " + words, 2, name, folder);
    }
    expect_error("sweep boxes --along light.azimuth=0:9 --steps 1 -o out", 2, "--steps 1", folder);
    expect_error("sweep boxes --along light.azimut=0:9 -o out", 2, "light.azimuth", folder);
    expect_error("sweep boxes --day 80,355 -o out", 2, "does not rise", folder);
    expect_error("sweep boxes --vary bias.slope=1 --worst-preset w.json -o out", 2, "--worst-preset", folder);
    expect_error("sweep boxes --along light.azimuth=0:9 --error nothing -o out", 2, "--error nothing", folder);
    EXPECT_FALSE(fs::exists(folder / "out"));
}

SI_TEST_IS(Later, LightPathCommand, AnInterruptLeavesNoFolder);
TEST(LightPathCommand, AnInterruptLeavesNoFolder) {
    const fs::path folder = fresh_test_folder();
    fs::create_directory(folder / "kept");
    const std::string sweep = "$SI sweep boxes --along light.azimuth=0:90 --steps 1000 --size 96x64 --no-time -o ";
    for (const char* output : {"out/path", "kept"}) {
        const ProcessResult r = run_shell(
            sweep + output + " >printed 2>said & " + signal_once("grep -q light.azimuth said", "INT") + "cat said",
            folder);
        EXPECT_NE(r.out.find("code 130\n"), std::string::npos) << r.out;
        EXPECT_NE(r.out.find("interrupted; nothing was written"), std::string::npos) << r.out;
        fs::remove(folder / "said");
    }
    EXPECT_FALSE(fs::exists(folder / "out"));
    EXPECT_TRUE(fs::exists(folder / "kept")) << "the command has not made it";
}

TEST(LightPathCommand, ReplacesItsOwnFilesOnly) {
    const fs::path folder = fresh_test_folder();
    const std::string command = "sweep boxes --along light.azimuth=0:9 --steps 2 --size 32x24 --no-time -o out";
    fs::create_directory(folder / "out");
    std::ofstream(folder / "out" / "path.html") << "mine";
    expect_error(command, 1, "path.html: exists, and no path.json says that a path's sweep wrote it", folder);
    EXPECT_EQ(file_bytes(folder / "out" / "path.html"), "mine");
    fs::remove(folder / "out" / "path.html");
    for (int run = 0; run < 2; ++run) {
        const ProcessResult r = run_program(Words(command), folder);
        EXPECT_EQ(r.code, 0) << r.err;
    }
}

}  // namespace
}  // namespace si
