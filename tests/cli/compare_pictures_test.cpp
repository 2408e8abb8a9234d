// Tests of `compare-pictures`, and of the difference that `measure` prints.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/flip_pairs.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

using Json = nlohmann::json;

class ComparePictures : public testing::Test {
protected:
    /// Returns the words of the command for the first committed pair. @param more further words
    Words command(const std::string& more = "") const {
        return Words{"compare-pictures", pair_.a.string(), pair_.b.string()} + Words(more);
    }

    const std::filesystem::path folder_ = fresh_test_folder();
    const test::FlipPair pair_ = test::committed_flip_pairs().front();
};

TEST_F(ComparePictures, PrintsMeanAndMaximumAsTextAndJson) {
    for (const test::FlipPair& pair : test::committed_flip_pairs()) {
        const Json json = program_json({"compare-pictures", pair.a.string(), pair.b.string(), "--ppd",
                                        std::to_string(pair.pixels_per_degree), "--json"});
        EXPECT_NEAR(json["flip"]["mean"], pair.mean, 2e-6) << pair.a;
        EXPECT_NEAR(json["flip"]["max"], pair.max, 5e-6) << pair.a;
        EXPECT_NEAR(json["pixels_per_degree"], pair.pixels_per_degree, 1e-5);
    }
    const ProcessResult text = run_program(command());
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_TRUE(text.out.starts_with("FLIP mean 0.19379")) << text.out;
    EXPECT_NE(text.out.find("48 x 32 pixels"), std::string::npos) << text.out;
    const ProcessResult same = run_program({"compare-pictures", pair_.a.string(), pair_.a.string()});
    EXPECT_TRUE(same.out.starts_with("FLIP mean 0.000000, max 0.000000 ")) << same.out;
}

TEST_F(ComparePictures, WritesAHeatMap) {
    const ProcessResult r = run_program(command("-o heat.png"), folder_);
    ASSERT_EQ(r.code, 0) << r.err;
    const ByteImage heat = test::picture_in(folder_ / "heat.png");
    EXPECT_EQ(heat.width, 48);
    EXPECT_EQ(heat.height, 32);
    int bright = 0;
    for (std::size_t i = 0; i < heat.data.size(); i += 4) bright += heat.data[i] > 150;
    EXPECT_GT(bright, 20) << "yellow at the edges of the shadow";
    EXPECT_LT(bright, 400);
}

TEST_F(ComparePictures, NamesTheFileThatCannotBeCompared) {
    const std::string a = pair_.a.string();
    std::filesystem::copy(pair_.a, folder_ / "mine.png");
    std::filesystem::create_symlink("mine.png", folder_ / "link.png");
    std::ofstream(folder_ / "cut.png") << file_bytes(pair_.a).substr(0, 120);
    std::string damaged = file_bytes(pair_.a);
    damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] ^ 1);
    std::ofstream(folder_ / "damaged.png") << damaged;
    std::ofstream(folder_ / "text.png") << "no picture";
    std::ofstream(folder_ / "empty.png");
    std::filesystem::create_directory(folder_ / "folder.png");
    const std::string other = test::committed_flip_pairs().back().a.string();
    expect_error({"compare-pictures", a, "none.png"}, 1, "none.png: cannot be opened", folder_);
    expect_error({"compare-pictures", "cut.png", a}, 1, "cut.png: the PNG is cut", folder_);
    expect_error({"compare-pictures", "damaged.png", a}, 1, "damaged.png: the PNG", folder_);
    expect_error({"compare-pictures", a, "text.png"}, 1, "text.png: the file is neither a PNG", folder_);
    expect_error({"compare-pictures", a, "empty.png"}, 1, "empty.png: the image is empty", folder_);
    expect_error({"compare-pictures", a, "folder.png"}, 1, "folder.png: is a directory", folder_);
    expect_error({"compare-pictures", a, other}, 1, "has 48 x 32 pixels", folder_);
    expect_error({"compare-pictures", a}, 2, "B", folder_);
    for (const char* ppd : {"0", "nan", "1e9", "many"})
        expect_error({"compare-pictures", a, a, "--ppd", ppd}, 2, "--ppd", folder_);
    expect_error({"compare-pictures", a, a, "-o", "heat.jpg"}, 2, "must end in .png", folder_);
    expect_error({"compare-pictures", a, a, "-o", "gone/heat.png"}, 1, "does not exist", folder_);
    const std::string before = file_bytes(folder_ / "mine.png");
    expect_error({"compare-pictures", "mine.png", a, "-o", "mine.png"}, 2, "is read", folder_);
    expect_error({"compare-pictures", a, "mine.png", "-o", "link.png"}, 2, "is read", folder_);
    EXPECT_EQ(file_bytes(folder_ / "mine.png"), before);
}

const Words kAcne =
    "boxes --size 128x72 --set filter.kernel=hard --set bias.kind=constant --set bias.constant=0 --set bias.normal=0";

SI_TEST_IS(Later, MeasuredFlip, IsPrintedAndIsThatOfTheDrawnPictures);
TEST(MeasuredFlip, IsPrintedAndIsThatOfTheDrawnPictures) {
    const auto folder = fresh_test_folder();
    const Json error = program_json("measure --no-time" + kAcne)["error"];
    const double flip = error["flip"];
    EXPECT_GT(flip, 0.02);
    const ProcessResult text = run_program("measure --no-time" + kAcne);
    EXPECT_NE(text.out.find("  FLIP "), std::string::npos) << text.out;
    // The picture left of a line at the right side, and the reference's right of one at the left side.
    for (const auto& [file, line] : {std::pair{"drawn.png", "1"}, {"reference.png", "0"}}) {
        const ProcessResult r = run_program("render" + kAcne + Words{"-o", file} +
                                                Words("--set view.smooth=false --against truth --swipe") + Words{line},
                                            folder);
        ASSERT_EQ(r.code, 0) << r.err;
    }
    const Json pictures = program_json("compare-pictures drawn.png reference.png --json", folder);
    EXPECT_NEAR(pictures["flip"]["mean"], flip, 1e-6);
}

TEST(MeasuredFlip, IsAColumnOfSweeps) {
    const auto folder = fresh_test_folder();
    const ProcessResult r =
        run_program(Words("sweep") + kAcne + Words("--vary map.resolution=128,2048 --no-time -o swept"), folder);
    ASSERT_EQ(r.code, 0) << r.err;
    const Json rows = Json::parse(file_bytes(folder / "swept/results.json"))["rows"];
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_GT(rows[0]["error"]["flip"], rows[1]["error"]["flip"]);
    EXPECT_NE(file_bytes(folder / "swept/results.csv").find("error.flip"), std::string::npos);
}

}  // namespace
}  // namespace si
