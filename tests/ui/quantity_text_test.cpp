// Tests of numbers with units in panels: digits, prefixes, no exponents, no line that ends within a number.
#include "ui/widgets/quantity_text.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>

#include "renderer/settings/param.h"
#include "tests/ui/ui_harness.h"
#include "ui/widgets/changes_text.h"
#include "ui/widgets/text.h"

namespace si::test {
namespace {

namespace fs = std::filesystem;

TEST(QuantityText, HasThreeDigitsAUnitAndNoExponent) {
    EXPECT_EQ(quantity_text(3.1329772020677598, "m"), "3.13 m");
    EXPECT_EQ(quantity_text(0.0042, "m"), "4.2 mm");
    EXPECT_EQ(quantity_text(1, "texels"), "1 texel");
    EXPECT_EQ(quantity_text(41.25, "deg"), "41.2°");
    EXPECT_EQ(quantity_text(4.19e6, "px"), "4.19 million px");
    EXPECT_EQ(quantity_text(-2.5e9), "-2.5 billion");
    EXPECT_EQ(quantity_text(1e-5, "ms"), "0.00001 ms");
    EXPECT_EQ(quantity_text(std::numeric_limits<double>::quiet_NaN(), "ms"), "no value");
    EXPECT_EQ(percent_text(0.0314159), "3.14 %");
    EXPECT_EQ(stored_text(1.2345678e-5, 3), "0.0000123");
    EXPECT_EQ(stored_text(4.19e6, 9), "4190000");
    EXPECT_EQ(stored_text(3.2e36, 3), "3.2 × 10^36");
    EXPECT_EQ(stored_text(0, 9), "0");
}

TEST(QuantityText, ChangesAreListedByLabelsAndUnits) {
    const Settings settings;
    const std::vector<std::pair<std::string, std::string>> changes = {{"light.distance", "3.1329772020677598"},
                                                                      {"map.resolution", "512"}};
    EXPECT_EQ(changes_line(settings, changes), "Distance: 3.133 m, Resolution: 512 texels");
    EXPECT_NE(changes_list(settings, changes).find("map.resolution"), std::string::npos) << "with its key";
    Settings with = settings, more = settings;
    with.lights[0].distance = 3.1329772020677598;
    more.lights[0].distance = 3.1329772020677612;
    const std::string change = change_text(with, more, *find_setting("light.distance"));
    EXPECT_LE(change.size(), std::string("3.132977202067760 → 3.132977202067761 m").size()) << change;
    more.lights[0].distance = 3.13300001;
    EXPECT_EQ(change_text(with, more, *find_setting("light.distance")), "3.13298 → 3.133 m");
}

TEST(QuantityText, NoPanelFormatsNumbersWithExponents) {
    const std::regex raw(R"(\{:[^}]*g\})");
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SI_SOURCE_DIR) / "ui")) {
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
        std::ifstream file(entry.path());
        std::stringstream text;
        text << file.rdbuf();
        const std::string all = text.str();
        std::smatch found;
        EXPECT_FALSE(std::regex_search(all, found, raw)) << entry.path() << ": " << found.str();
    }
}

TEST(QuantityText, LinesBreakNeitherNumbersNorBeforeUnits) {
    UiHarness ui(400, 300);
    ui.frames(2);
    ImGui::NewFrame();
    for (float width = 30; width < 220; width += 3) {
        const std::string lines = broken_at_spaces("needs 3.25 texels of 0.125 mm, not 12 px here", width);
        for (const char* whole : {"3.25 texels", "0.125 mm,", "12 px"})
            EXPECT_NE(lines.find(whole), std::string::npos) << width << ": " << lines;
    }
    ImGui::EndFrame();
}

TEST(QuantityText, SettingsShowSmallValuesWithoutExponents) {
    UiHarness ui(1280, 1400);
    ui.state.settings_panel.search = "minimum variance";
    set_setting(ui.state.settings, "filter.kernel", "vsm");
    set_setting(ui.state.settings, "filter.min_variance", "0.000001");
    ui.frames(4);
    EXPECT_EQ(ui.lacking({"0.0000010"}), "");
    EXPECT_FALSE(ui.prints("1e-06"));
}

}  // namespace
}  // namespace si::test
