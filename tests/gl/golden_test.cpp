// Compares a picture of each row of each table of techniques with its reviewed golden picture (tests/golden).
#include "tests/support/golden.h"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "app/base/output.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

constexpr int kTolerance = 8;  ///< accepted difference in any channel, of 255

/// Returns the share of pixels that may differ by more than kTolerance. The pictures are llvmpipe's, which may round
/// otherwise on another machine. Lavapipe under zink differed in 0.6 % where 16 bits hold four moments, elsewhere in
/// 0.2 % at most.
/// @returns nothing for other drivers, whose rasterisers have rules of their own
std::optional<double> max_differing_share(std::string_view driver) {
    if (driver.find("llvmpipe") == std::string_view::npos) return {};
    return driver.starts_with("zink") ? 0.01 : 0.002;
}

/// Returns the sentence that says how to accept the picture that is drawn now.
std::string fix(const GoldenPicture& picture) {
    return fmt::format("If the picture that is drawn now is right, keep it: scripts/document_technique.sh {}",
                       picture.choice());
}

class GoldenTest : public FrameTest, public testing::WithParamInterface<std::string> {};

SI_TESTS_ARE(Repeated, GoldenTest);
TEST_P(GoldenTest, RowsMatchTheirGoldenPictures) {
    const std::string driver = current_driver();
    const std::optional<double> most = max_differing_share(driver);
    if (!most) GTEST_SKIP() << "the golden pictures are llvmpipe's, and this is " << driver;
    const std::filesystem::path folder = fresh_test_folder();
    for (const GoldenPicture& picture : golden_pictures(GetParam())) {
        SCOPED_TRACE(picture.name());
        const ByteImage now = draw_golden(renderer, picture);
        const ByteImage golden = read_golden(golden_file(golden_folder(), picture));
        const auto keep = [&](const char* what, const ByteImage& image) {
            const std::filesystem::path file = folder / fmt::format("{}-{}.png", picture.name(), what);
            write_png(file, image);
            return file.string();
        };
        if (golden.data.empty()) {
            ADD_FAILURE() << "there is no golden picture of this row; it draws " << keep("drawn", now) << ". "
                          << fix(picture);
            continue;
        }
        if (golden.width != now.width || golden.height != now.height) {
            ADD_FAILURE() << "the golden picture has another size. " << fix(picture);
            continue;
        }
        const std::size_t different = different_pixels(now, golden, kTolerance);
        if (double(different) > *most * now.width * now.height)
            ADD_FAILURE() << different << " of " << now.width * now.height << " pixels differ by more than "
                          << kTolerance << "/255: " << keep("drawn", now) << ", eightfold in "
                          << keep("difference", golden_difference(now, golden)) << ". " << fix(picture);
    }
}

std::string table_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::erase(name, '-');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Each, GoldenTest, testing::ValuesIn(golden_tables()), table_name);

TEST(GoldenPictures, ShowExistingRows) {
    std::set<std::filesystem::path> rows;
    for (const std::string& table : golden_tables())
        for (const GoldenPicture& picture : golden_pictures(table)) rows.insert(golden_file(golden_folder(), picture));
    for (const auto& file : std::filesystem::directory_iterator(golden_folder()))
        EXPECT_TRUE(rows.contains(file.path())) << file.path() << " is of no row: delete it";
}

}  // namespace
}  // namespace si::test
