// Tests of --check-numeric: exit code 0 for finite numbers, 1 with the place of the first fault.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "app/cli/cli.h"
#include "renderer/gl/driver_failure.h"
#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

const Words kSearched = "--size 64x48 --set map.resolution=64 --set map.format=colour --check-numeric";

SI_TEST_IS(Later, CheckNumeric, ReportsFiniteNumbers);
TEST(CheckNumeric, ReportsFiniteNumbers) {
    const Json health = program_json("measure boxes --no-time" + kSearched)["numeric_health"];
    EXPECT_EQ(health["sound"], true);
    EXPECT_GE(health["images"], 3);
    EXPECT_GT(health["numbers"], 64 * 64 + 2 * 64 * 48);
    EXPECT_TRUE(health["findings"].empty());
    const Json unsearched = program_json("measure boxes --no-time --size 64x48 --set map.resolution=64");
    EXPECT_TRUE(unsearched["numeric_health"].is_null());
}

/// Runs a command in this process, where a NaN can be put into a map.
/// @param spoilt_from smallest map, in texels, that gets a NaN
ProcessResult run_here(const Words& arguments, int spoilt_from = 0) {
    std::vector<const char*> argv = {"shadow-inspector"};
    for (const std::string& a : arguments) argv.push_back(a.c_str());
    gl::fault_injection().corrupt_image = [spoilt_from](std::string_view image, GLuint texture) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        GLint width = 0;
        glGetTextureLevelParameteriv(texture, 0, GL_TEXTURE_WIDTH, &width);
        if (image == "shadow map" && width >= spoilt_from)
            glTextureSubImage2D(texture, 0, 12, 40, 1, 1, GL_RED, GL_FLOAT, &nan);
    };
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = run_cli(int(argv.size()), argv.data());
    gl::fault_injection() = {};
    return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

/// Runs a command in this process and expects exit code 1 and texts within standard error.
void expect_spoilt(const Words& arguments, std::initializer_list<std::string_view> texts, int spoilt_from = 0) {
    const ProcessResult r = run_here(arguments, spoilt_from);
    EXPECT_EQ(r.code, 1) << testing::PrintToString(arguments);
    EXPECT_EQ(test::lacking(r.err, texts), "") << testing::PrintToString(arguments);
}

TEST(CheckNumeric, NamesThePlaceAndFailsForEveryPicture) {
    const auto folder = fresh_test_folder();
    const std::string place = "NaN in 1 texel of the shadow map of light 0: first at texel 12, 40";
    for (const Words& command :
         {Words{"render", "boxes", "-o", folder / "a.png", "--report", folder / "a.json"},
          Words("measure boxes --no-time"), Words("plan boxes"), Words("probe boxes --pixel 30,30 --no-truth"),
          Words{"truth", "boxes", "-o", folder / "t.png"}})
        expect_spoilt(command + kSearched, {"--check-numeric: " + place});
    EXPECT_TRUE(std::filesystem::exists(folder / "t.png")) << "what was asked for is written all the same";
    const Json report = Json::parse(file_bytes(folder / "a.json"));
    ASSERT_EQ(report["numeric_health"]["findings"].size(), 1u);
    const Json& finding = report["numeric_health"]["findings"][0];
    EXPECT_EQ(finding["fault"], "nan");
    EXPECT_EQ(finding["light"], 0);
    EXPECT_EQ(finding["first"], Json({12, 40}));
    EXPECT_TRUE(finding["value"].is_null());
}

SI_TEST_IS(Slow, CheckNumeric, NamesTheFirstFaultyCaseOfMany);
TEST(CheckNumeric, NamesTheFirstFaultyCaseOfMany) {
    const auto folder = fresh_test_folder();
    const std::string place = "NaN in 1 texel of the shadow map of light 0",
                      as_given = "--check-numeric: the settings as given: " + place;
    const Words sweep =
        "sweep boxes --vary map.resolution=64,128,256 --no-time --fresh -o" + Words{folder / "sweep"} + kSearched;
    const ProcessResult sound = run_here(sweep, 1000);
    EXPECT_EQ(sound.code, 0) << sound.err;
    // The picture of 256 texels has a fault, too.
    expect_spoilt(sweep, {"--check-numeric: with --set map.resolution=128: " + place, "pictures have faults"}, 128);
    EXPECT_TRUE(std::filesystem::exists(folder / "sweep/results.csv")) << "the sweep is lost";
    const Words path = "sweep boxes --along light.azimuth=10:40 --steps 2 --no-time -o" + Words{folder / "path"};
    const ProcessResult sound_path = run_here(path + kSearched, 1000);
    EXPECT_EQ(sound_path.code, 0) << sound_path.err;
    expect_spoilt(path + kSearched, {"--check-numeric: ", place});
    EXPECT_TRUE(std::filesystem::exists(folder / "path/path.json")) << "the path is lost";
    expect_spoilt(Words{"tune", "boxes", "-o", folder / "tuned.json"} + kSearched, {as_given});
    EXPECT_TRUE(std::filesystem::exists(folder / "tuned.json"));
    expect_spoilt("advise boxes --max-error 1 --vary filter.kernel=hard --seconds 1" + kSearched, {as_given});
}

SI_TEST_IS(Later, CheckNumeric, EditorDrawsAndReportsAtItsEnd);
TEST(CheckNumeric, EditorDrawsAndReportsAtItsEnd) {
    const auto folder = fresh_test_folder();
    const std::filesystem::path screenshot = folder / "e.png", report = folder / "r.json";
    const Words line = Words{"edit", "boxes", "--headless", "--screenshot", screenshot, "--report", report} +
                       "--size 640x400 --set map.resolution=64 --set map.format=colour --check-numeric";
    const ProcessResult sound = run_here(line, 1000);
    EXPECT_EQ(sound.code, 0) << sound.err;
    Json session = Json::parse(file_bytes(report));
    EXPECT_TRUE(session["unsound"].is_null());
    EXPECT_EQ(session["driver_messages"]["count"], 0);
    EXPECT_GT(session["frames"], 0);
    EXPECT_GT(session["memory"]["resident"], 1 << 20);
    bool maps = false;
    for (const Json& h : session["memory"]["holders"]) maps |= h["holder"] == "shadow maps" && h["bytes"] > 64 * 64;
    EXPECT_TRUE(maps) << session["memory"];
    std::filesystem::remove(screenshot);
    expect_spoilt(line, {"--check-numeric: boxes ", "--set map.resolution=64",
                         "NaN in 1 texel of the shadow map of light 0: first at texel 12, 40"});
    EXPECT_TRUE(std::filesystem::exists(screenshot));
    session = Json::parse(file_bytes(report));
    EXPECT_FALSE(session["unsound"].is_null());
    EXPECT_GT(session["errors"]["count"], 0);
}

}  // namespace
}  // namespace si
