// Tests of `precision` and `shimmer`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

TEST(LabCommands, PrecisionIsPrintedOverDistance) {
    const Json now = program_json("precision boxes --size 64x36");
    ASSERT_EQ(now["pipelines"].size(), 4u);
    EXPECT_EQ(now["pipelines"][0]["map.origin"], "near");
    const Json over = program_json("precision boxes --size 64x36 --over distance");
    const Json& last = over["series"].back();
    EXPECT_EQ(last["value"], 1e7);
    EXPECT_LT(last["pipelines"][0]["texels"]["median"], 0.05);
    EXPECT_GT(last["pipelines"][2]["texels"]["median"], 1);
    EXPECT_EQ(last["pipelines"][2]["map.origin"], "world");
}

SI_TEST_IS(Later, LabCommands, ShimmerIsPrintedWithAndWithoutSnapping);
TEST(LabCommands, ShimmerIsPrintedWithAndWithoutSnapping) {
    const auto folder = fresh_test_folder();
    const Json shimmer = program_json("shimmer stage --preset cascades --size 96x54 --steps 4 -o flips.png", folder);
    ASSERT_EQ(shimmer["variants"].size(), 3u);
    EXPECT_EQ(shimmer["variants"][1]["variant"], "snapped");
    EXPECT_EQ(shimmer["variants"][1]["flips_a_step"], 0);
    EXPECT_GT(shimmer["variants"][2]["flips_a_step"], 0);
    EXPECT_EQ(shimmer["variants"][2]["flips"].size(), 4u);
    EXPECT_TRUE(std::filesystem::exists(folder / "flips.png"));
}

}  // namespace
}  // namespace si
