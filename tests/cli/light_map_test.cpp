// Tests of light maps on the command line: baked before the frame, cached on disk, listed in the report.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/process.h"
#include "tests/support/text.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class LightMapCommand : public testing::Test {
protected:
    fs::path folder_ = fresh_test_folder();
    const fs::path cache_ = fs::path(SI_TEST_OUTPUT_DIR) / "cache/shadow-inspector/light-maps";
    /// Azimuth of the light that no earlier run used, so that the disk cache misses.
    const std::string azimuth_ = std::to_string(10 + ::getpid() % 100000 * 1e-3);

    std::set<fs::path> kept() const {
        std::set<fs::path> out;
        std::error_code none;
        for (const auto& e : fs::directory_iterator(cache_, none)) out.insert(e.path());
        return out;
    }
    /// Returns the report's facts of light 0. @param note expected text on stderr
    Json draw(const Words& more, std::string* note = nullptr) {
        const Words arguments =
            "render boxes -o v.pfm --view visibility --size 160x90 --report r.json --set light.source=light-map "
            "--set " +
            ("light.azimuth=" + azimuth_);
        const ProcessResult r = run_program(arguments + more, folder_);
        EXPECT_EQ(r.code, 0) << r.err;
        if (note)
            *note = r.err;
        else
            EXPECT_EQ(r.err, "");
        return r.code == 0 ? Json::parse(file_bytes(folder_ / "r.json"))["light_maps"][0] : Json();
    }
    std::string picture() const { return file_bytes(folder_ / "v.pfm"); }
};

SI_TEST_IS(Later, LightMapCommand, BakesOnceAndKeepsItOnDisk);
TEST_F(LightMapCommand, BakesOnceAndKeepsItOnDisk) {
    const std::set<fs::path> before = kept();
    const Json uncached = draw("--no-cache");
    EXPECT_TRUE(uncached["baked"]);
    EXPECT_FALSE(uncached["from_disk"]);
    EXPECT_EQ(uncached["bytes"], 1024 * 1024);
    EXPECT_GT(uncached["rays"], 100000);
    const std::string first = picture();
    EXPECT_EQ(kept(), before) << "--no-cache writes nothing";

    EXPECT_FALSE(draw({})["from_disk"]);
    std::set<fs::path> added = kept();
    for (const fs::path& p : before) added.erase(p);
    ASSERT_EQ(added.size(), 1u);
    EXPECT_TRUE(draw({})["from_disk"]);
    EXPECT_EQ(picture(), first);
    EXPECT_TRUE(draw("--set camera.source=manual --set camera.azimuth=80")["from_disk"]);
    EXPECT_FALSE(draw("--no-cache")["from_disk"]);

    fs::resize_file(*added.begin(), 1000);
    std::string note;
    EXPECT_FALSE(draw({}, &note)["from_disk"]);
    EXPECT_EQ(test::lacking(note, {"note: ", "cut short"}), "");
    EXPECT_EQ(picture(), first);
    EXPECT_TRUE(draw({})["from_disk"]);
    fs::remove(*added.begin());
}

}  // namespace
}  // namespace si
