// Tests of `precision` and `shimmer`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

using Json = nlohmann::json;

Json json_of_command(std::vector<std::string> words) {
    words.push_back("--json");
    const ProcessResult r = run_program(words);
    EXPECT_EQ(r.code, 0) << r.err;
    return Json::parse(r.out);
}

TEST(LabCommands, PrecisionIsPrintedOverDistance) {
    const Json now = json_of_command({"precision", "boxes", "--size", "64x36"});
    ASSERT_EQ(now["pipelines"].size(), 4u);
    EXPECT_EQ(now["pipelines"][0]["map.origin"], "near");
    const Json over = json_of_command({"precision", "boxes", "--size", "64x36", "--over", "distance"});
    const Json& last = over["series"].back();
    EXPECT_EQ(last["value"], 1e7);
    EXPECT_LT(last["pipelines"][0]["texels"]["median"], 0.05);
    EXPECT_GT(last["pipelines"][2]["texels"]["median"], 1);
    EXPECT_EQ(last["pipelines"][2]["map.origin"], "world");
}

TEST(LabCommands, ShimmerIsPrintedWithAndWithoutSnapping) {
    const auto folder = fresh_test_folder();
    const Json shimmer = json_of_command({"shimmer", "stage", "--preset", "cascades", "--size", "96x54", "--steps", "4",
                                          "-o", (folder / "flips.png").string()});
    ASSERT_EQ(shimmer["variants"].size(), 3u);
    EXPECT_EQ(shimmer["variants"][1]["variant"], "snapped");
    EXPECT_EQ(shimmer["variants"][1]["flips_a_step"], 0);
    EXPECT_GT(shimmer["variants"][2]["flips_a_step"], 0);
    EXPECT_EQ(shimmer["variants"][2]["flips"].size(), 4u);
    EXPECT_TRUE(std::filesystem::exists(folder / "flips.png"));
}

}  // namespace
}  // namespace si
