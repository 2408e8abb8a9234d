// Tests the table of hard cases: every row has a text, a scene, settings that open without a fault, a test, and its
// line in docs/lab/stability.md. The setting that brings the fault back does so.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/session/presets.h"
#include "app/session/session.h"
#include "renderer/measure/measured_error.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/idle_reason.h"
#include "tests/support/hard_view.h"
#include "tests/support/stability.h"
#include "tests/support/traits.h"

namespace si::test {
namespace {

std::string view_identifier(const testing::TestParamInfo<HardCaseView>& info) {
    return identifier(info.param.name().substr(kHardPrefix.size()));
}

TEST(HardCaseTable, EveryRowHasATextASceneAndALimit) {
    const auto rows = hard_cases();
    ASSERT_GE(rows.size(), 36u);
    std::set<std::string_view> keys, titles;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const HardCase& row = rows[i];
        EXPECT_EQ(row.number, int(i) + 1);
        EXPECT_TRUE(keys.insert(row.key).second && titles.insert(row.title).second) << row.key;
        for (const std::string_view sentence : {row.fault, row.fix}) {
            EXPECT_TRUE(sentence.size() > 30 && sentence.ends_with('.')) << row.key << ": " << sentence;
            EXPECT_LT(sentence.size(), 200u) << row.key << ": longer than a glance";
        }
        for (const std::string_view words : {row.measure, row.limit_reason, row.fault_measure})
            EXPECT_GT(words.size(), 10u) << row.key;
        EXPECT_FALSE(row.unit.empty()) << row.key;
        EXPECT_GE(row.limit, 0);
        EXPECT_GT(row.min_fault, 0) << row.key << ": a case that cannot fail is a defect";
        EXPECT_EQ(row.broken.empty(), row.fixed.empty()) << row.key;
        ASSERT_NE(row.make, nullptr);
    }
}

// Suites carry the row's number in their name, plain and parameterised ones.
TEST(HardCaseTable, EveryRowHasTestsOfItsNumber) {
    const testing::UnitTest& all = *testing::UnitTest::GetInstance();
    for (const HardCase& row : hard_cases()) {
        const std::string wanted = "HardCase" + std::to_string(row.number);
        int found = 0;
        for (int i = 0; i < all.total_test_suite_count(); ++i) {
            const std::string name = all.GetTestSuite(i)->name();
            const auto at = name.find(wanted);
            if (at == std::string::npos) continue;
            const char next = at + wanted.size() < name.size() ? name[at + wanted.size()] : ' ';
            found += !(next >= '0' && next <= '9');
        }
        EXPECT_GT(found, 0) << wanted << ", " << row.title;
    }
}

TEST(HardCaseTable, IsInTheDocumentForBothDrivers) {
    for (const char* driver : kStabilityDrivers) {
        const auto lines = stability_rows(driver);
        for (const HardCase& row : hard_cases()) {
            const auto it = std::ranges::find(lines, row.number, &StabilityRow::number);
            ASSERT_NE(it, lines.end()) << "docs/lab/stability.md lacks " << row.key << " on " << driver
                                       << "; scripts/stability.sh writes it";
            const auto wanted = stability_cells(row);
            ASSERT_GE(it->cells.size(), wanted.size() + 5);
            for (std::size_t i = 0; i < wanted.size(); ++i)
                EXPECT_EQ(it->cells[i], wanted[i]) << driver << ": write it again by scripts/stability.sh";
            EXPECT_EQ(it->verdict(), "holds") << row.key << " on " << driver;
        }
    }
}

class HardCasePresets : public testing::TestWithParam<HardCaseView> {};

TEST_P(HardCasePresets, OpensAsPresetAndAsScene) {
    const HardCaseView& view = GetParam();
    const std::string name = view.name();
    ASSERT_TRUE(is_builtin_scene(name));
    const Session preset = open_session({.scene = {}, .preset = name, .sets = {}});
    const Session scene = open_session({.scene = name, .preset = {}, .sets = {}});
    EXPECT_EQ(preset.settings, scene.settings);
    EXPECT_EQ(preset.scene_name, name);
    EXPECT_EQ(load_preset(name).settings, view.settings());
    EXPECT_LT(view.about().size(), 420u);
    // Notes about the case's own subject are allowed; all others are faults of the preset.
    static const std::set<std::string_view> remarks = {"spot-angle", "bad-numbers", "degenerate",    "not-finite",
                                                       "exponents",  "map-size",    "flattened",     "light-inside",
                                                       "no-depth",   "split-ends",  "reversed-depth"};
    const Shot shot = draw_shot(preset.scene, preset.settings, 96, 72);
    if (remarks.contains(view.row->key)) return;
    EXPECT_TRUE(preset.notes.empty()) << preset.notes.front();
    for (const std::string& note : shot.frame.notes) ADD_FAILURE() << note;
    for (const SettingRef& ref : changed_settings(preset.settings))
        EXPECT_EQ(idle_reason(preset.settings, ref), "") << setting_key(ref);
}

INSTANTIATE_TEST_SUITE_P(Each, HardCasePresets, testing::ValuesIn(hard_case_views().begin(), hard_case_views().end()),
                         view_identifier);

SI_TEST_IS(DriverIndependent, HardCaseTable, PresetsOfFaultsShowTheFault);
// The picture of the fault has more errors than that of the fix, compared with the reference.
SI_TEST_IS(Later, HardCaseTable, PresetsOfFaultsShowTheFault);
TEST(HardCaseTable, PresetsOfFaultsShowTheFault) {
    for (const HardCase& row : hard_cases()) {
        if (row.broken.empty()) continue;
        // Left out are faults that show only as the camera moves, and faults that the reference shares.
        if (row.key == "snapping" || row.key == "alpha") continue;
        double wrong[2] = {}, mae[2] = {};
        for (const bool fixed : {false, true}) {
            const DrawnCase c = hard_view(row.key, fixed);
            ReferenceCache cache;
            const MeasuredError e =
                measure_error(hard_renderer(), c.scene, c.settings, {.width = 160, .height = 120}, 0, {}, cache);
            wrong[fixed] = e.metrics.false_light + e.metrics.false_shadow;
            mae[fixed] = e.metrics.mae;
        }
        RecordProperty(std::string(row.key), std::to_string(wrong[0]) + " " + std::to_string(wrong[1]));
        EXPECT_GT(mae[0], 1.3 * mae[1]) << row.key << ": " << wrong[0] << " and " << wrong[1] << " wrong";
    }
}

}  // namespace
}  // namespace si::test
