// Tests of sweep axes: lists of values, errors, and the cross product.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "renderer/base/error.h"
#include "renderer/measure/axes.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/param.h"
#include "tests/support/error_text.h"

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
    const auto refused = [](const char* text, std::string_view reason) {
        return test::fails_with<UsageError>([&] { parse_axis(text); }, {reason});
    };
    EXPECT_TRUE(refused("bias.constnat=1", "bias.constant"));
    EXPECT_TRUE(refused("bias.constant", "KEY=V1"));
    EXPECT_TRUE(refused("bias.constant=", "KEY=V1"));
    EXPECT_TRUE(refused("bias.constant=a:b:c", "from:to:step"));
    EXPECT_TRUE(refused("bias.constant=0:1:-1", "does not lead"));
    EXPECT_TRUE(refused("bias.constant=0:1:0", "does not lead"));
    EXPECT_TRUE(refused("map.resolution=1:1024:*1", "does not lead"));
    EXPECT_TRUE(refused("bias.constant=0:1:1e-9", "larger step"));
    EXPECT_THROW(parse_axis("filter.kernel=nonsense"), UsageError);
    EXPECT_TRUE(refused("light.1.name=key,fill", "nothing that is measured depends on it"));
    EXPECT_THROW(parse_axis("map.resolution=1e9"), UsageError);
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
    const auto plan_size_twice = [] {
        plan_sweep({}, {parse_axis("filter.size=3,5"), parse_axis("filter.kernel=hard,pcf9")});
    };
    EXPECT_TRUE(test::fails_with<UsageError>(plan_size_twice, {"pcf9 stands for filter.size=9"}));
    EXPECT_EQ(plan_sweep({}, {parse_axis("filter.kernel=hard,pcf"), parse_axis("filter.size=2:5:1")}).cases.size(), 5u);
}

TEST(SweepAxes, RepeatedKeysAndTooManyCasesAreRefused) {
    EXPECT_THROW(plan_sweep({}, {parse_axis("bias.constant=1"), parse_axis("bias.constant=2")}), UsageError);
    const auto many = [](const char* key) { return parse_axis(std::string(key) + "=0:0.9:0.001"); };
    EXPECT_THROW(plan_sweep({}, {many("bias.constant"), many("bias.slope")}), UsageError);
}

}  // namespace
}  // namespace si
