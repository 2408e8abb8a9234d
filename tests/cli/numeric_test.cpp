// Tests of --check-numeric: exit code 0 for finite numbers, 1 with the place of the first fault.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "app/cli/cli.h"
#include "renderer/gl/driver_failure.h"
#include "tests/support/process.h"

namespace si {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> kSearched = {
    "--size", "64x48", "--set", "map.resolution=64", "--set", "map.format=colour", "--check-numeric"};

std::vector<std::string> with_small_sizes(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), kSearched.begin(), kSearched.end());
    return arguments;
}

TEST(CheckNumeric, ReportsFiniteNumbers) {
    const ProcessResult r = run_program(with_small_sizes({"measure", "boxes", "--no-time", "--json"}));
    ASSERT_EQ(r.code, 0) << r.err;
    const Json health = Json::parse(r.out)["numeric_health"];
    EXPECT_EQ(health["sound"], true);
    EXPECT_GE(health["images"], 3);
    EXPECT_GT(health["numbers"], 64 * 64 + 2 * 64 * 48);
    EXPECT_TRUE(health["findings"].empty());
    const ProcessResult without_check =
        run_program({"measure", "boxes", "--no-time", "--json", "--size", "64x48", "--set", "map.resolution=64"});
    EXPECT_TRUE(Json::parse(without_check.out)["numeric_health"].is_null());
}

/// Runs a command in this process, where a NaN can be put into a map.
/// @param spoilt_from smallest map, in texels, that gets a NaN
int run_here(std::vector<std::string> arguments, std::string& out, std::string& err, int spoilt_from = 0) {
    arguments.insert(arguments.begin(), "shadow-inspector");
    std::vector<const char*> argv;
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
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    gl::fault_injection() = {};
    return code;
}

TEST(CheckNumeric, NamesThePlaceAndFailsForEveryPicture) {
    const auto folder = fresh_test_folder();
    const std::string place = "NaN in 1 texel of the shadow map of light 0: first at texel 12, 40";
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"render", "boxes", "-o", (folder / "a.png").string(), "--report", (folder / "a.json").string()},
             {"measure", "boxes", "--no-time"},
             {"plan", "boxes"},
             {"probe", "boxes", "--pixel", "30,30", "--no-truth"},
             {"truth", "boxes", "-o", (folder / "t.png").string()}}) {
        std::string out, err;
        EXPECT_EQ(run_here(with_small_sizes(command), out, err), 1) << command[0];
        EXPECT_NE(err.find("--check-numeric: " + place), std::string::npos) << command[0] << ": " << err;
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "t.png")) << "what was asked for is written all the same";
    const Json report = Json::parse(file_bytes(folder / "a.json"));
    ASSERT_EQ(report["numeric_health"]["findings"].size(), 1u);
    const Json& finding = report["numeric_health"]["findings"][0];
    EXPECT_EQ(finding["fault"], "nan");
    EXPECT_EQ(finding["light"], 0);
    EXPECT_EQ(finding["first"], Json({12, 40}));
    EXPECT_TRUE(finding["value"].is_null());
}

TEST(CheckNumeric, NamesTheFirstFaultyCaseOfMany) {
    const auto folder = fresh_test_folder();
    const std::string sweep = (folder / "sweep").string(), place = "NaN in 1 texel of the shadow map of light 0";
    std::string out, err;
    const auto swept = [&](std::vector<std::string> more) {
        std::vector<std::string> line = {"sweep",     "boxes",   "--vary", "map.resolution=64,128,256",
                                         "--no-time", "--fresh", "-o",     sweep};
        line.insert(line.end(), more.begin(), more.end());
        return with_small_sizes(line);
    };
    EXPECT_EQ(run_here(swept({}), out, err, 1000), 0) << err;
    EXPECT_EQ(run_here(swept({}), out, err, 128), 1);
    EXPECT_NE(err.find("--check-numeric: with --set map.resolution=128: " + place), std::string::npos) << err;
    EXPECT_NE(err.find("pictures have faults"), std::string::npos) << "that of 256 texels has one, too: " << err;
    EXPECT_TRUE(std::filesystem::exists(folder / "sweep/results.csv")) << "the sweep is lost";

    const std::string tuned = (folder / "tuned.json").string();
    EXPECT_EQ(run_here(with_small_sizes({"tune", "boxes", "-o", tuned}), out, err), 1);
    EXPECT_NE(err.find("--check-numeric: the settings as given: " + place), std::string::npos) << err;
    EXPECT_TRUE(std::filesystem::exists(tuned));
    EXPECT_EQ(run_here(with_small_sizes(
                           {"advise", "boxes", "--max-error", "1", "--vary", "filter.kernel=hard", "--seconds", "1"}),
                       out, err),
              1);
    EXPECT_NE(err.find("--check-numeric: the settings as given: " + place), std::string::npos) << err;
}

TEST(CheckNumeric, EditorDrawsAndReportsAtItsEnd) {
    const auto folder = fresh_test_folder();
    const std::string screenshot = (folder / "e.png").string(), report = (folder / "r.json").string();
    const std::vector<std::string> line = {
        "edit",   "boxes",   "--headless", "--screenshot",      screenshot, "--report",          report,
        "--size", "640x400", "--set",      "map.resolution=64", "--set",    "map.format=colour", "--check-numeric"};
    std::string out, err;
    EXPECT_EQ(run_here(line, out, err, 1000), 0) << err;
    Json session = Json::parse(file_bytes(report));
    EXPECT_TRUE(session["unsound"].is_null());
    EXPECT_EQ(session["driver_messages"]["count"], 0);
    EXPECT_GT(session["frames"], 0);
    EXPECT_GT(session["memory"]["resident"], 1 << 20);
    bool maps = false;
    for (const Json& h : session["memory"]["holders"]) maps |= h["holder"] == "shadow maps" && h["bytes"] > 64 * 64;
    EXPECT_TRUE(maps) << session["memory"];
    std::filesystem::remove(screenshot);
    EXPECT_EQ(run_here(line, out, err), 1);
    EXPECT_NE(err.find("--check-numeric: boxes "), std::string::npos) << err;
    EXPECT_NE(err.find("--set map.resolution=64"), std::string::npos) << "it does not say of what settings: " << err;
    EXPECT_NE(err.find("NaN in 1 texel of the shadow map of light 0: first at texel 12, 40"), std::string::npos) << err;
    EXPECT_TRUE(std::filesystem::exists(screenshot));
    session = Json::parse(file_bytes(report));
    EXPECT_FALSE(session["unsound"].is_null());
    EXPECT_GT(session["errors"]["count"], 0);
}

}  // namespace
}  // namespace si
