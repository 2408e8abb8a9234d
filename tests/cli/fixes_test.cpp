// Tests of fixes on the command line: a row's settings, given to `measure`, cure and break exactly the reported number
// of pixels.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

Json run(const char* command, const Words& more) {
    return program_json(command +
                        Words("boxes --set map.resolution=512 --set bias.kind=constant --set bias.normal=0 --set "
                              "bias.constant=0 --size 320x180") +
                        more);
}

long long wrong_pixel_count(const Json& measured) {
    long long n = 0;
    for (const auto& [cause, pixels] : measured["error"]["artefacts"].items())
        if (cause != "none") n += pixels.get<long long>();
    return n;
}

SI_TEST_IS(Slow, FixesInJson, AreNullUnlessRequestedAndReachTheirFigures);
TEST(FixesInJson, AreNullUnlessRequestedAndReachTheirFigures) {
    EXPECT_TRUE(run("measure", "--no-time")["cures"].is_null());
    const Json all = run("measure", "--no-time --cures");
    ASSERT_TRUE(all["cures"].is_array());
    const Json& first = all["cures"][0];
    EXPECT_GT(first["cured_px"], 1000);
    EXPECT_TRUE(first["fix"].get<bool>());
    EXPECT_TRUE(first["ms"].is_object()) << "the price of a fix is known";
    EXPECT_LT(first["error"]["after"], first["error"]["before"]);
    for (const Json& row : all["cures"])
        if (row["tried"].get<bool>()) {
            EXPECT_EQ(row["fix"].get<bool>(), row["why_not"].is_null());
        }
    EXPECT_EQ(wrong_pixel_count(run("measure", "--no-time" + set_words(first["settings"]))),
              wrong_pixel_count(all) - first["cured_px"].get<long long>() + first["broken_px"].get<long long>());
}

}  // namespace
}  // namespace si
