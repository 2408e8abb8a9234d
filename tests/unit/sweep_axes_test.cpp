// Tests of sweep axes: lists of values, errors, and the cross product.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "renderer/base/error.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

using Texts = std::vector<std::string>;

TEST(SweepAxes, ListRowsAndEveryChoice) {
    EXPECT_EQ(parse_axis("map.resolution=512,1024").values, (Texts{"512", "1024"}));
    EXPECT_EQ(parse_axis("map.resolution=256:2048:*2").values, (Texts{"256", "512", "1024", "2048"}));
    EXPECT_EQ(parse_axis("bias.constant=0:0.3:0.1").values, (Texts{"0", "0.1", "0.2", "0.3"}));
    EXPECT_EQ(parse_axis("bias.constant=2:0:-1").values, (Texts{"2", "1", "0"}));
    EXPECT_EQ(parse_axis("map.far_guard=*").values, (Texts{"false", "true"}));
    EXPECT_EQ(parse_axis("caster.cull=*").values, (Texts{"none", "back", "front"}));
    EXPECT_EQ(parse_axis("filter.kernel=pcf3,hard").values, (Texts{"pcf3", "hard"}));
    EXPECT_EQ(parse_axis("bias.constant=1,1.0,2").values, (Texts{"1", "2"})) << "a value twice is one value";
    EXPECT_EQ(parse_axis("light.0.azimuth=1").key, "light.azimuth") << "keys are canonical";
}

TEST(SweepAxes, MistakesAreNamed) {
    const auto message = [](const char* text) -> std::string {
        try {
            parse_axis(text);
        } catch (const UsageError& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_NE(message("bias.constnat=1").find("bias.constant"), std::string::npos);
    EXPECT_NE(message("bias.constant").find("KEY=V1"), std::string::npos);
    EXPECT_NE(message("bias.constant=").find("KEY=V1"), std::string::npos);
    EXPECT_NE(message("bias.constant=a:b:c").find("from:to:step"), std::string::npos);
    EXPECT_NE(message("bias.constant=0:1:-1").find("does not lead"), std::string::npos);
    EXPECT_NE(message("bias.constant=0:1:0").find("does not lead"), std::string::npos);
    EXPECT_NE(message("map.resolution=1:1024:*1").find("does not lead"), std::string::npos);
    EXPECT_NE(message("bias.constant=0:1:1e-9").find("larger step"), std::string::npos);
    EXPECT_FALSE(message("filter.kernel=nonsense").empty());
    EXPECT_NE(message("light.1.name=key,fill").find("nothing that is measured depends on it"), std::string::npos);
    EXPECT_FALSE(message("map.resolution=1e9").empty());
}

TEST(SweepAxes, CrossProductVariesTheLastAxisFastest) {
    const SweepPlan plan =
        plan_sweep({}, {parse_axis("map.resolution=512,1024"), parse_axis("filter.kernel=hard,pcf3")});
    ASSERT_EQ(plan.cases.size(), 4u);
    EXPECT_EQ(plan.cases[0].id, "map.resolution=512 filter.kernel=hard");
    EXPECT_EQ(plan.cases[1].id, "map.resolution=512 filter.kernel=pcf3");
    EXPECT_EQ(plan.cases[3].settings.map.resolution, 1024);
}

TEST(SweepAxes, SettingsWithoutEffectCollapse) {
    Settings base;
    base.shading.specular = 0;  // shininess has no effect
    const SweepPlan plan = plan_sweep(base, {parse_axis("shading.specular=0,1"), parse_axis("shading.shininess=8,64")});
    EXPECT_EQ(plan.product, 4u);
    EXPECT_EQ(plan.cases.size(), 3u);
    Settings poisson;
    set_setting(poisson, "filter.kernel", "poisson");
    EXPECT_EQ(plan_sweep({}, {parse_axis("filter.radius=1,2,3")}).cases.size(), 1u) << "of another kernel";
    EXPECT_EQ(plan_sweep(poisson, {parse_axis("filter.radius=1,2,3")}).cases.size(), 3u);
    Settings off;
    off.light_count = 1;
    EXPECT_EQ(plan_sweep(off, {parse_axis("light.3.azimuth=1,2,3")}).cases.size(), 1u) << "light 3 is off";
}

TEST(SweepAxes, EveryKernelIsEachRowAtItsOwnSizes) {
    const SweepAxis axis = parse_axis("filter.kernel=*");
    std::set<int> rows;
    std::size_t sizes = 0;
    for (const std::string& value : axis.values) {
        Settings s;
        set_setting(s, "filter.kernel", value);
        rows.insert(s.filter.kernel);
        const Filter& row = filter_of(s);
        if (row.swept.empty()) {
            EXPECT_EQ(value, row.key);
            continue;
        }
        ++sizes;
        EXPECT_NE(std::ranges::find(row.swept, value), row.swept.end()) << value << " is of another row";
        EXPECT_EQ(value.starts_with(row.key) && value.find(std::to_string(taps_across(row, s))) != std::string::npos,
                  true)
            << value << " says its size";
    }
    EXPECT_EQ(rows.size(), filters().size()) << "none is left out";
    EXPECT_GE(sizes, 10u);
    EXPECT_EQ(plan_sweep({}, {axis}).cases.size(), axis.values.size()) << "each is a case of its own";
    try {
        plan_sweep({}, {parse_axis("filter.size=3,5"), parse_axis("filter.kernel=hard,pcf9")});
        ADD_FAILURE() << "the size is said twice";
    } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()).find("pcf9 stands for filter.size=9"), std::string::npos) << e.what();
    }
    EXPECT_EQ(plan_sweep({}, {parse_axis("filter.kernel=hard,pcf"), parse_axis("filter.size=2:5:1")}).cases.size(), 5u);
}

TEST(SweepAxes, RepeatedKeysAndTooManyCasesAreRefused) {
    EXPECT_THROW(plan_sweep({}, {parse_axis("bias.constant=1"), parse_axis("bias.constant=2")}), UsageError);
    const auto many = [](const char* key) { return parse_axis(std::string(key) + "=0:0.9:0.001"); };
    EXPECT_THROW(plan_sweep({}, {many("bias.constant"), many("bias.slope")}), UsageError);
}

}  // namespace
}  // namespace si
