// Tests docs/engine-frame.md: its pictures are those that its commands draw, and are listed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <sstream>

#include "renderer/gltf/image_decode.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

const fs::path kDocs = fs::path(SI_SOURCE_DIR) / "docs";
const fs::path kScript = fs::path(SI_SOURCE_DIR) / "scripts/engine_frame_pictures.sh";

gltf::Image png_of(const fs::path& file) {
    const std::string png = file_bytes(file);
    return gltf::decode_image({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()});
}

TEST(EngineFramePage, ShowsEachPictureWithTheCommandThatDrawsIt) {
    const std::string page = file_bytes(kDocs / "engine-frame.md");
    std::istringstream script(file_bytes(kScript));
    const std::regex drawn("draw (\\S+\\.png) (.*)");
    std::size_t pictures = 0;
    for (std::string line; std::getline(script, line);) {
        std::smatch found;
        if (!std::regex_match(line, found, drawn)) continue;
        ++pictures;
        EXPECT_NE(page.find("./run.sh " + found[2].str() + " -o "), std::string::npos) << line;
        EXPECT_NE(page.find("images/engine-frame/" + found[1].str()), std::string::npos) << line;
    }
    EXPECT_EQ(pictures, 5u);
    for (const auto& file : fs::directory_iterator(kDocs / "images/engine-frame")) {
        const std::string name = file.path().filename().string();
        EXPECT_NE(page.find("images/engine-frame/" + name), std::string::npos) << name << " is shown nowhere";
        EXPECT_NE(file_bytes(kScript).find(name), std::string::npos) << name << " is made by no command";
        EXPECT_LT(fs::file_size(file.path()), 250'000u) << name;
    }
}

// Pixels on edges may differ by driver.
SI_TEST_IS(Later, EngineFramePage, PicturesAreThoseThatTheCommandsDraw);
TEST(EngineFramePage, PicturesAreThoseThatTheCommandsDraw) {
    const fs::path folder = fresh_test_folder();
    const fs::path build = fs::path(SI_BUNDLE_WRITERS).parent_path();
    const ProcessResult run =
        run_shell("'" + kScript.string() + "' '" + build.string() + "' '" + folder.string() + "' --without-editor");
    ASSERT_EQ(run.code, 0) << run.err;
    std::size_t compared = 0;
    for (const auto& file : fs::directory_iterator(folder)) {
        SCOPED_TRACE(file.path().filename());
        ++compared;
        const gltf::Image a = png_of(file.path()), b = png_of(kDocs / "images/engine-frame" / file.path().filename());
        ASSERT_EQ(a.width, b.width);
        ASSERT_EQ(a.rgba.size(), b.rgba.size());
        std::size_t far = 0;
        for (std::size_t i = 0; i < a.rgba.size(); ++i) far += std::abs(int(a.rgba[i]) - int(b.rgba[i])) > 8;
        EXPECT_LT(double(far), 0.005 * double(a.rgba.size()));
    }
    EXPECT_EQ(compared, 5u);
}

}  // namespace
}  // namespace si
