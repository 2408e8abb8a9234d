// Tests of presets on two drivers: the one at hand, and zink over lavapipe.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include "app/session/presets.h"
#include "tests/support/process.h"
#include "tests/support/traits.h"

namespace si {
namespace {

namespace fs = std::filesystem;

/// Draws every preset into `folder`. Returns the driver's name.
std::string draw_presets(const std::string& launcher, const fs::path& folder) {
    fs::create_directories(folder);
    const std::string command =
        launcher + " '" SI_DRAW_PRESETS "' '" + folder.string() + "' > '" + (folder / "log.txt").string() + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << file_bytes(folder / "log.txt");
    std::istringstream log(file_bytes(folder / "log.txt"));
    std::string driver;
    std::getline(log, driver);
    return driver;
}

std::vector<float> floats(const fs::path& file) {
    const std::string bytes = file_bytes(file);
    std::vector<float> out(bytes.size() / sizeof(float));
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(out.data()));
    return out;
}

SI_TEST_IS(Slow, Drivers, PresetsLookAlikeOnTwoDrivers);
TEST(Drivers, PresetsLookAlikeOnTwoDrivers) {
    const fs::path folder = fresh_test_folder();
    const std::string one = draw_presets("env -u MESA_LOADER_DRIVER_OVERRIDE", folder / "one");
    const std::string other = draw_presets("'" SI_SOURCE_DIR "/scripts/on_zink.sh'", folder / "other");
    ASSERT_NE(other.find("zink"), std::string::npos) << other;
    ASSERT_EQ(one.find("zink"), std::string::npos) << "both are " << one;
    for (const BuiltinPreset& preset : builtin_presets()) {
        SCOPED_TRACE(preset.key);
        // Presets that show limits of single precision differ by driver.
        if (preset.key == "texture-matrix" || preset.key == "savsm-float-sums") continue;
        const std::string a = file_bytes(folder / "one" / (preset.key + ".rgba"));
        const std::string b = file_bytes(folder / "other" / (preset.key + ".rgba"));
        ASSERT_EQ(a.size(), 320u * 180u * 4u);
        ASSERT_EQ(b.size(), a.size());
        const auto va = floats(folder / "one" / (preset.key + ".visibility"));
        const auto vb = floats(folder / "other" / (preset.key + ".visibility"));
        ASSERT_EQ(va.size(), vb.size());
        std::size_t rounded = 0, far = 0, turned = 0;
        for (std::size_t i = 0; i < a.size(); i += 4) {
            int most = 0;
            for (std::size_t c = 0; c < 4; ++c)
                most = std::max(most, std::abs(int(static_cast<unsigned char>(a[i + c])) -
                                               int(static_cast<unsigned char>(b[i + c]))));
            rounded += most > 0;
            far += most > 2;
        }
        for (std::size_t i = 0; i < va.size(); ++i) turned += std::abs(va[i] - vb[i]) > 0.02f;
        EXPECT_GT(std::set<char>(a.begin(), a.end()).size(), 6u) << "hardly a picture";
        // Colours round differently. A pixel may change where rounding decides whether a tap is lit: on edges, and in
        // presets about too few depth steps. Most such pixels, 1.1 %, are in receiver-plane: its bias compensates
        // rounding only.
        const double pixels = double(a.size()) / 4;
        EXPECT_LE(double(rounded), 0.05 * pixels);
        EXPECT_LE(double(far), 0.01 * pixels) << "more than 2/255";
        EXPECT_LE(double(turned), 0.015 * pixels) << "visibility";
    }
}

}  // namespace
}  // namespace si
