// --check-numeric: 0 where all numbers are sound, 1 with the place where one is not.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "app/cli/cli.h"
#include "renderer/gl/trouble.h"
#include "tests/support/process.h"

namespace si {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kSearched = {
    "--size", "64x48", "--set", "map.resolution=64", "--set", "map.format=colour", "--check-numeric"};

std::vector<std::string> with_small(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), kSearched.begin(), kSearched.end());
    return arguments;
}

TEST(CheckNumeric, SaysThatAllNumbersAreSound) {
    const ProcessResult r = run_program(with_small({"measure", "boxes", "--no-time", "--json"}));
    ASSERT_EQ(r.code, 0) << r.err;
    const Json health = Json::parse(r.out)["numeric_health"];
    EXPECT_EQ(health["sound"], true);
    EXPECT_GE(health["images"], 3);
    EXPECT_GT(health["numbers"], 64 * 64 + 2 * 64 * 48);
    EXPECT_TRUE(health["findings"].empty());
    const ProcessResult unasked =
        run_program({"measure", "boxes", "--no-time", "--json", "--size", "64x48", "--set", "map.resolution=64"});
    EXPECT_TRUE(Json::parse(unasked.out)["numeric_health"].is_null());
}

/// In this process, where a NaN can be put into a map.
int run_here(std::vector<std::string> arguments, std::string& out, std::string& err) {
    arguments.insert(arguments.begin(), "shadow-inspector");
    std::vector<const char*> argv;
    for (const std::string& a : arguments) argv.push_back(a.c_str());
    gl::trouble_seam().spoils = [](std::string_view image, GLuint texture) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        if (image == "shadow map") glTextureSubImage2D(texture, 0, 12, 40, 1, 1, GL_RED, GL_FLOAT, &nan);
    };
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = run_cli(int(argv.size()), argv.data());
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    gl::trouble_seam() = {};
    return code;
}

TEST(CheckNumeric, NamesThePlaceAndFailsWhereverAPictureIsDrawn) {
    const auto folder = fresh_test_folder();
    const std::string place = "NaN in 1 texel of the shadow map of light 0: first at texel 12, 40";
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"render", "boxes", "-o", (folder / "a.png").string(), "--report", (folder / "a.json").string()},
             {"measure", "boxes", "--no-time"},
             {"plan", "boxes"},
             {"probe", "boxes", "--pixel", "30,30", "--no-truth"}}) {
        std::string out, err;
        EXPECT_EQ(run_here(with_small(command), out, err), 1) << command[0];
        EXPECT_NE(err.find("--check-numeric: " + place), std::string::npos) << command[0] << ": " << err;
    }
    const Json report = Json::parse(file_bytes(folder / "a.json"));
    ASSERT_EQ(report["numeric_health"]["findings"].size(), 1u);
    const Json& finding = report["numeric_health"]["findings"][0];
    EXPECT_EQ(finding["fault"], "nan");
    EXPECT_EQ(finding["light"], 0);
    EXPECT_EQ(finding["first"], Json({12, 40}));
    EXPECT_TRUE(finding["value"].is_null());
}

}  // namespace
}  // namespace si
