// Tests of the table of biases: closed forms of the rows, and the settings that they read.
#include "renderer/settings/biases.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/bias/account.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/mesh_scene.h"

namespace si {
namespace {

Settings settings_of_kind(std::string_view kind) {
    Settings s;
    set_setting(s, "bias.kind", kind);
    return s;
}

TEST(Biases, KindsAreTheRowsOfTheComparedDepth) {
    std::size_t kinds = 0;
    for (const Bias& row : biases()) {
        EXPECT_TRUE(row.amount) << row.key;
        if (row.stage != BiasStage::Compare) continue;
        ASSERT_LT(kinds, bias_choices().size());
        EXPECT_EQ(bias_choices()[kinds++].key, row.key) << "they come first";
    }
    EXPECT_EQ(kinds, bias_choices().size());
    EXPECT_EQ(bias_of(Settings{}).key, "adaptive");
    EXPECT_EQ(&bias_of(settings_of_kind("receiver-plane")),
              &*std::ranges::find(biases(), "receiver-plane", &Bias::key));
    EXPECT_EQ(bias_of_stage(BiasStage::LookUp).key, "normal-offset");
}

TEST(Biases, AmountsAreTheClosedForms) {
    BiasInput b{.curve = {.perspective = false, .near = 2, .far = 10},
                .texel_m = 0.05,
                .n_dot_l = 0.25,
                .least_per_texel = 1e-4};
    Settings s;
    s.bias.constant = 2;
    s.bias.slope = 8;  // 6 at 1 - n.l = 3/4
    const auto amount = [&](std::string_view kind, BiasUnit unit) {
        s.bias.unit = unit;
        set_setting(s, "bias.kind", kind);
        return bias_of(s).amount(s.bias, b);
    };
    EXPECT_DOUBLE_EQ(amount("slope", BiasUnit::Depth), 6);
    EXPECT_DOUBLE_EQ(amount("slope", BiasUnit::Metres), 6.0 / 8);
    EXPECT_DOUBLE_EQ(amount("slope", BiasUnit::Texels), 6 * 0.05 / 8);
    EXPECT_DOUBLE_EQ(amount("constant", BiasUnit::Metres), 2.0 / 8);
    EXPECT_DOUBLE_EQ(amount("receiver-plane", BiasUnit::Metres), 2.0 / 8 + 1e-4);
    b.per_texel = {0.02, -0.03};
    b.least_common = 0.7;
    EXPECT_DOUBLE_EQ(amount("receiver-plane-derivatives", BiasUnit::Metres), 2.0 / 8 + 1e-4 + 0.05);
    // Half a texel's width and a sixteenth of the slope at the look-up, twice that per texel of distance.
    EXPECT_DOUBLE_EQ(amount("receiver-plane-remainder", BiasUnit::Metres),
                     2.0 / 8 + 1e-4 + 0.5 * (0.05 / 8 + 0.05 / 8));
    EXPECT_DOUBLE_EQ(bias_of(s).remainder(b), 0.05 / 8 + 0.05 / 8);
    EXPECT_DOUBLE_EQ(amount("adaptive", BiasUnit::Metres), 0.7);
    b.n_dot_l = -1;  // away from the light: treated as edge-on
    EXPECT_DOUBLE_EQ(amount("slope", BiasUnit::Depth), 8);
    b.n_dot_l = 1;
    EXPECT_DOUBLE_EQ(amount("slope", BiasUnit::Depth), 2);
    // A metre from a perspective light: depth = far (z - near) / (z (far - near)).
    b.curve = {.perspective = true, .near = 1, .far = 9};
    b.z = 4;
    const auto depth = [](double z) { return 9 * (z - 1) / (z * 8); };
    EXPECT_NEAR(amount("constant", BiasUnit::Metres), depth(4) - depth(2), 1e-12);
}

TEST(Biases, ListTheirIdleSettings) {
    const auto idle = [](const Settings& s, const char* key) {
        return std::string(idle_reason(s, *find_setting(key)));
    };
    Settings s = settings_of_kind("slope");
    s.bias.slope = 3;
    EXPECT_EQ(idle(s, "bias.slope"), "");
    EXPECT_EQ(idle(s, "bias.plane_clamp"),
              "without effect: only bias.kind receiver-plane or receiver-plane-derivatives or receiver-plane-remainder "
              "reads it");
    s = settings_of_kind("receiver-plane");
    s.bias.slope = 3;
    EXPECT_EQ(idle(s, "bias.slope"), "without effect: only bias.kind slope reads it");
    EXPECT_EQ(idle(s, "bias.plane_clamp"), "");
    EXPECT_EQ(idle(s, "bias.constant"), "");
    s = settings_of_kind("adaptive");
    EXPECT_NE(idle(s, "bias.constant"), "") << "it has no number to turn";
    EXPECT_NE(idle(s, "bias.unit"), "");
    s = settings_of_kind("receiver-plane");
    s.bias.normal = 0;
    EXPECT_NE(idle(s, "bias.normal_source"), "");
    s = settings_of_kind("constant");
    s.bias.slope = 3;
    EXPECT_NE(idle(s, "bias.slope"), "");
    EXPECT_EQ(idle(s, "bias.raster_slope"), "") << "what acts beside is never idle by kind";
}

// Rows list existing settings, and a listed setting changes nothing under rows that do not list it.
TEST(Biases, ListOnlyTheirOwnSettings) {
    const FittedLight light = fit_lights(make_scene(make_plane(10, 10)), Settings{})[0];
    for (const Bias& row : biases())
        for (const std::string_view key : row.settings) {
            ASSERT_TRUE(find_setting(key)) << key;
            if (row.stage != BiasStage::Compare || find_setting(key)->param->choices) continue;
            for (const Choice& kind : bias_choices()) {
                Settings s = settings_of_kind(kind.key);
                const auto account = [&] {
                    return bias_breakdown(light, s, 512, {{1, 0, 2}, {0, 1, 0}, {0, 1, 0}, {}}, {.subpixel_bits = 8});
                };
                const auto differs = [&](const BiasBreakdown& a, const BiasBreakdown& b) {
                    return a.equivalent_depth() != b.equivalent_depth() || a.least.total() != b.least.total() ||
                           a.compared_depth_at({0.3, 0.3}) != b.compared_depth_at({0.3, 0.3});
                };
                const BiasBreakdown before = account();
                set_setting(s, key, "0.7");
                const BiasBreakdown less = account();
                set_setting(s, key, "900");
                const BiasBreakdown more = account();
                const bool reads = reads_setting(bias_of(s), key);
                EXPECT_EQ(differs(before, less) || differs(before, more), reads) << kind.key << " and " << key;
            }
        }
}

}  // namespace
}  // namespace si
