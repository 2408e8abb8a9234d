// Tests of the `truth` command: pictures, reports, mistakes.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"

namespace si {
namespace {

using Json = nlohmann::json;

class ReferenceCommand : public testing::Test {
protected:
    /// Runs `truth` and returns the report; the picture is t.pfm.
    Json trace(const Words& more, const char* scene = "boxes") {
        const ProcessResult r =
            run_program(Words{"truth", scene} + "-o t.pfm --size 160x90 --report t.json" + more, folder_);
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(r.out, "");
        EXPECT_EQ(r.err, "");
        return r.code == 0 ? Json::parse(file_bytes(folder_ / "t.json")) : Json();
    }
    const std::filesystem::path folder_ = fresh_test_folder();
};

TEST_F(ReferenceCommand, WritesThePictureAndItsFacts) {
    const Json hard = trace({});
    const std::string picture = file_bytes(folder_ / "t.pfm");
    EXPECT_EQ(picture.size(), std::string("Pf\n160 90\n-1.0\n").size() + 160 * 90 * 4);
    EXPECT_EQ(hard["format"], "shadow-inspector-truth");
    EXPECT_GT(hard["pixels"]["counted"], 1000);
    int sum = 0;
    for (const auto& [state, count] : hard["pixels"].items()) sum += count.get<int>();
    EXPECT_EQ(sum, 160 * 90);
    EXPECT_GT(hard["visibility_mean"], 0.2);
    EXPECT_LT(hard["visibility_mean"], 0.99);
    EXPECT_EQ(hard["visibility_mean"], hard["hard_visibility_mean"]);
    EXPECT_FALSE(hard.contains("noise"));

    EXPECT_EQ(trace("--threads 1")["rays"], hard["rays"]);
    EXPECT_EQ(file_bytes(folder_ / "t.pfm"), picture) << "the threads show";

    const Json area = trace("--area --set light.0.size=5 --samples 256");
    EXPECT_NE(file_bytes(folder_ / "t.pfm"), picture);
    EXPECT_GT(area["partly_lit"], 200);
    EXPECT_GT(area["noise"], 0);
    EXPECT_LT(area["noise"], 0.02);
    EXPECT_EQ(area["samples"], 256) << "at most";
    EXPECT_EQ(area["samples_used"]["least"], 8);
    EXPECT_EQ(area["samples_used"]["most"], 256);
    EXPECT_GT(area["samples_used"]["mean"], 8);
    EXPECT_GT(area["rays"], 8 * hard["rays"].get<int>());
    EXPECT_EQ(area["hard_visibility_mean"], hard["visibility_mean"]);
}

TEST_F(ReferenceCommand, OneSampleHasUnknownNoise) {
    const Json one = trace("--area --set light.0.size=5 --samples 3");
    EXPECT_TRUE(one["noise"].is_null()) << one["noise"];
    EXPECT_EQ(one["noise_unknown_px"], one["pixels"]["counted"]);
    EXPECT_EQ(one["samples_used"]["most"], 3);
    const Words measure = "measure boxes --area --set light.0.size=5 --set truth.samples=1 --no-time --size 160x90";
    const ProcessResult words = run_program(measure, folder_);
    EXPECT_NE(words.out.find("noise unknown, 1 sample a pixel"), std::string::npos) << words.out;
    const Json m = program_json(measure, folder_);
    EXPECT_TRUE(m["error"]["noise"].is_null());
    EXPECT_TRUE(m["truth"]["noise"].is_null());
    EXPECT_EQ(m["truth"]["samples_used"]["mean"], 1);
}

TEST_F(ReferenceCommand, IncludesCulledFacesUnlessAsRasterised) {
    // The stage has a wall of a single plane.
    const double all = trace({}, "stage")["visibility_mean"];
    EXPECT_EQ(trace("--set caster.cull=front", "stage")["visibility_mean"], all);
    EXPECT_EQ(trace("--set caster.cull=none --as-rasterised", "stage")["visibility_mean"], all);
    const double front = trace("--set caster.cull=front --as-rasterised", "stage")["visibility_mean"];
    const double back = trace("--set caster.cull=back --as-rasterised", "stage")["visibility_mean"];
    EXPECT_GT(std::max(front, back), all + 1e-3);
}

}  // namespace
}  // namespace si
