// Tests of the knowledge of an engine's bias: what a bundle states, what somebody enters, and what is unknown.
#include "renderer/bundle/engine_bias.h"

#include <gtest/gtest.h>

#include "renderer/bundle/given_maps.h"
#include "renderer/settings/param.h"
#include "tests/support/sets.h"

namespace si {
namespace {

LightView engine_bias_view() {
    LightView view;
    view.curve = {.perspective = false, .near = 0, .far = 20, .convention = {}, .warp = {}};
    view.set_half_extents(glm::dvec2(4));
    return view;
}

ImportedMaps one_map(std::optional<BiasSettings> bias) {
    ImportedMaps out = *imported_maps({FloatImage{1, 1, 1, {0}}}, std::nullopt, {}, bias.has_value());
    out.bias = std::move(bias);
    return out;
}

/// Returns a bundle of one light whose look-up has all amounts of bias.
Bundle biased_bundle() {
    Bundle out;
    out.lights.resize(1);
    out.lights[0].maps.resize(1);
    out.lights[0].lookup.bias = {.constant = 0.0005, .slope = 0.25, .normal = 0.125, .units = {}};
    out.lights[0].lookup.bias.units = {BiasUnit::Depth, BiasUnit::Depth, BiasUnit::Metres};
    return out;
}

std::optional<BiasSettings> stated(const Bundle& bundle) {
    return stated_bias(bundle, bundle.lights[0]);
}

TEST(EngineBias, IsWhatTheFileStatesWhatIsEnteredOrUnknown) {
    const Settings plain;
    Settings other = settings_with(plain, {"bias.constant=0.5"});
    const ImportedMaps known = one_map(plain.bias), unknown = one_map(std::nullopt);
    EXPECT_EQ(engine_bias(nullptr, plain), EngineBias::Own);
    EXPECT_EQ(engine_bias(&known, plain), EngineBias::File);
    EXPECT_EQ(engine_bias(&known, other), EngineBias::Changed);
    EXPECT_EQ(engine_bias(&unknown, plain), EngineBias::Unknown);
    EXPECT_EQ(engine_bias(&unknown, other), EngineBias::Unknown) << "amounts alone are no statement";
    for (const ImportedMaps* maps : {&known, &unknown})
        for (const char* constant : {"0", "0.5"}) {
            const Settings s = settings_with(plain, {std::string("bias.constant=") + constant});
            EXPECT_EQ(engine_bias(maps, settings_with(s, {"map.bundle_bias=entered"})), EngineBias::Entered);
            EXPECT_EQ(engine_bias(maps, settings_with(s, {"map.bundle_bias=unknown"})), EngineBias::Unknown);
        }
    const auto drawn = drawn_maps(ImportedViews{{engine_bias_view()}, {}}, MapSize(8));
    EXPECT_EQ(engine_bias(drawn.get(), settings_with(plain, {"map.bundle_bias=entered"})), EngineBias::Own);

    // Polygon offset is a part of the map, and no part of the look-up.
    EXPECT_EQ(engine_bias(&known, settings_with(plain, {"bias.raster_slope=2", "bias.raster_units=3"})),
              EngineBias::File);
    for (const char* change : {"bias.kind=constant", "bias.unit=metres", "bias.slope=2", "bias.normal=1",
                               "bias.plane_clamp=3", "bias.normal_source=shading"})
        EXPECT_EQ(engine_bias(&known, settings_with(plain, {change})), EngineBias::Changed) << change;
}

TEST(EngineBias, HasNamesAndRemarks) {
    struct Row {
        EngineBias bias;
        const char *key, *source;
        bool known;
    };
    for (const auto& [bias, key, source, known] : {Row{EngineBias::Own, "own", "", false},
                                                   {EngineBias::File, "known", "file", true},
                                                   {EngineBias::Entered, "known", "entered", true},
                                                   {EngineBias::Changed, "changed", "file", false},
                                                   {EngineBias::Unknown, "unknown", "", false}}) {
        EXPECT_EQ(engine_bias_key(bias), key);
        EXPECT_EQ(engine_bias_source_key(bias), source);
        EXPECT_EQ(is_known(bias), known);
        EXPECT_EQ(engine_bias_text(bias).empty(), bias == EngineBias::Own);
    }
    const Settings plain;
    const ImportedMaps known = one_map(plain.bias), unknown = one_map(std::nullopt);
    EXPECT_EQ(engine_bias_remark(&known, plain, 0), "");
    EXPECT_EQ(engine_bias_remark(nullptr, plain, 0), "");
    EXPECT_TRUE(engine_bias_remark(&unknown, plain, 2).starts_with("light 2: the bias with which the engine reads"));
    EXPECT_NE(engine_bias_remark(&unknown, plain, 2).find("map.bundle_bias to entered"), std::string::npos);
    EXPECT_TRUE(engine_bias_remark(&known, settings_with(plain, {"bias.normal=1"}), 0)
                    .starts_with("light 0: bias.* are not the bias that the bundle states"));
    EXPECT_EQ(engine_bias_remark(&unknown, settings_with(plain, {"map.bundle_bias=entered"}), 0), "");
}

TEST(EngineBias, AFileStatesItOnlyWhole) {
    const auto whole = stated(biased_bundle());
    ASSERT_TRUE(whole);
    const Settings s = settings_with(Settings{}, {"bias.kind=slope", "bias.unit=depth", "bias.constant=0.0005",
                                                  "bias.slope=0.25", "bias.normal=0.125", "bias.normal_unit=metres"});
    EXPECT_EQ(*whole, s.bias);

    for (std::optional<double> BundleBias::*amount : {&BundleBias::constant, &BundleBias::slope, &BundleBias::normal}) {
        Bundle part = biased_bundle();
        (part.lights[0].lookup.bias.*amount).reset();
        EXPECT_FALSE(stated(part)) << "unknown is not 0";
        part.settings["view.overlay"] = "normals";
        EXPECT_FALSE(stated(part)) << "settings of something else state no bias";
    }
    // Amounts that bias.* cannot hold are as good as unknown.
    Bundle units = biased_bundle();
    units.lights[0].lookup.bias.units[1] = BiasUnit::Metres;
    EXPECT_FALSE(stated(units));
    Bundle negative = biased_bundle();
    negative.lights[0].lookup.bias.constant = -0.0005;
    EXPECT_FALSE(stated(negative));
    Bundle depth = biased_bundle();
    depth.lights[0].lookup.bias.units[2] = BiasUnit::Depth;
    EXPECT_FALSE(stated(depth)) << "a depth is no length";
    depth.lights[0].lookup.bias.normal = 0;
    EXPECT_TRUE(stated(depth)) << "0 has no unit";
}

TEST(EngineBias, SettingsOfThisProgramStateIt) {
    Bundle bundle = biased_bundle();
    bundle.lights[0].lookup = {};
    EXPECT_FALSE(settings_state_bias(bundle));
    bundle.settings = {{"bias.kind", "adaptive"}, {"bias.unit", "texels"}, {"bias.constant", "0.5"},
                       {"bias.slope", "0"},       {"bias.normal", "2"},    {"bias.raster_slope", "3"}};
    EXPECT_TRUE(settings_state_bias(bundle));
    const auto whole = stated(bundle);
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->constant, 0.5);
    EXPECT_EQ(whole->normal, 2);
    EXPECT_EQ(whole->raster_slope, 0);
    bundle.settings.erase("bias.normal");
    EXPECT_FALSE(stated(bundle));
}

}  // namespace
}  // namespace si
