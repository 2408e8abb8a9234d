// Compares imported maps with maps drawn from the scene, where the difference is known in closed form.
#include "renderer/inspect/map_comparison.h"

#include <cmath>

#include "app/report/map_comparison_report.h"
#include "renderer/base/error.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"

namespace si {
namespace {

using Maps = std::vector<std::shared_ptr<const ImportedMaps>>;

/// Scene of a floor of 16 m and a box on it, whose top is 4 m above the floor. Seen from above, the box covers 2 m by
/// 1 m around (1, -0.5), 3 cm more on each side than whole texels of 0.125 m.
Scene floor_and_tall_box() {
    return test::grey_scene({{"floor", make_plane(16, 16)}, {"box", make_box({2.06, 4, 1.06}), moved(1, 2, -0.5)}});
}

class MapComparisonTest : public FrameTest {
protected:
    /// Returns a view straight down over 8 m by 8 m, whose depths run from 5 m above the floor to 5 m below.
    static LightView from_above(bool reversed = false) {
        LightView view;
        view.eye = {0, 20, 0};
        view.axes = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
        view.curve = {.perspective = false, .near = 15, .far = 25, .convention = {.reversed = reversed}, .warp = {}};
        view.set_half_extents(glm::dvec2(4));
        return view;
    }
    /// Returns a view of a light 12 m above the floor that looks straight down, with tangents of 0.5.
    static LightView from_lamp() {
        LightView view;
        view.eye = {0, 12, 0};
        view.axes = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
        view.curve = {.perspective = true, .near = 2, .far = 20, .convention = {}, .warp = {}};
        view.set_half_extents(glm::dvec2(0.5));
        return view;
    }
    static Settings plain(const Sets& sets = {}) {
        return settings_with(test::texel_settings("hard", 64, 0), joined({{"map.format", "d16"}}, sets));
    }
    /// Draws a map with a view and returns it as if an engine had given it.
    std::shared_ptr<const ImportedMaps> as_given(const Scene& scene, const Settings& s, const LightView& view,
                                                 MapSize size = 64, std::vector<CasterRaster> raster = {}) {
        FrameRequest request{.width = 16, .height = 16, .outputs = {.colour = false, .shadow_map = true}};
        request.imported = {drawn_maps({{view}, {}}, size, std::move(raster))};
        const FrameResult frame = renderer.render(scene, s, request);
        return imported_maps({renderer.read_shadow_map(frame, 0, 0)}, ImportedViews{{view}, {}});
    }
    ComparedMap compare(const Scene& scene, const Settings& s, std::shared_ptr<const ImportedMaps> theirs,
                        const MapCompareOptions& options = {}) {
        return compare_imported_maps(renderer, scene, s, {std::move(theirs)}, 0, options).at(0);
    }
};

TEST_F(MapComparisonTest, OwnMapsPassTheGateWithoutADifference) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    struct Light {
        LightType type;
        LightFit fit;
        MapSize size;
    };
    for (const Light& light : {Light{LightType::Directional, LightFit::Scene, 128},
                               {LightType::Directional, LightFit::Lispsm, {64, 256}},
                               {LightType::Spot, LightFit::Scene, {256, 64}},
                               {LightType::Point, LightFit::Scene, 64}})
        for (const char* format : {"d16", "d32f"})
            for (const char* reversed : {"false", "true"}) {
                SCOPED_TRACE(testing::Message() << int(light.type) << " " << format << " " << reversed);
                Settings s = settings_with(plain(), {{"map.format", format}, {"map.reversed_z", reversed}});
                s.lights[0].type = light.type;
                s.lights[0].fit = light.fit;
                s.lights[0].cone = 80;
                if (light.type != LightType::Directional) s.lights[0].distance = 9;
                FrameRequest request{.width = 96, .height = 72, .outputs = {.shadow_map = true}};
                request.map_size = light.size;
                const FrameResult frame = renderer.render(scene, s, request);
                std::vector<FloatImage> images;
                for (std::size_t v = 0; v < frame.lights[0].views.size(); ++v)
                    images.push_back(renderer.read_shadow_map(frame, 0, int(v)));
                const auto theirs =
                    imported_maps(images, ImportedViews{frame.lights[0].views, frame.lights[0].chooser});
                for (const ComparedMap& map : compare_imported_maps(renderer, scene, s, {theirs}, 0)) {
                    const MapComparison& n = map.numbers;
                    EXPECT_TRUE(n.gate.passed()) << n.gate.text;
                    EXPECT_EQ(n.missed + n.extra + n.nearer + n.farther, 0u);
                    EXPECT_EQ(n.depth.max, 0);
                    EXPECT_EQ(n.size, light.size);
                    EXPECT_TRUE(map.lacking.empty());
                    EXPECT_EQ(n.name.empty(), images.size() == 1);
                }
            }
}

// From above, 16 by 8 texels have their centres on the box.
TEST_F(MapComparisonTest, ACasterThatOneMapLacksIsCountedExactly) {
    const Scene scene = floor_and_tall_box();
    for (const bool reversed : {false, true}) {
        const LightView view = from_above(reversed);
        const Settings all = plain({{"map.reversed_z", reversed ? "true" : "false"}});
        Settings no_floor = all, floor_alone = all, nothing = all;
        no_floor.objects["floor"].cast = false;
        floor_alone.objects["box"].cast = false;
        nothing.objects["floor"].cast = nothing.objects["box"].cast = false;

        // Over nothing, the caster's texels are extra.
        ComparedMap map = compare(scene, no_floor, as_given(scene, nothing, view));
        EXPECT_EQ(map.numbers.extra, 128u);
        EXPECT_EQ(map.numbers.missed, 0u);
        EXPECT_EQ(map.numbers.lacking.from, glm::ivec2(32, 24));
        EXPECT_EQ(map.numbers.lacking.to, glm::ivec2(48, 32));
        EXPECT_FALSE(map.numbers.gate.extra);
        ASSERT_EQ(map.lacking.size(), 1u);
        EXPECT_EQ(map.lacking[0].path, "box");
        EXPECT_EQ(map.lacking[0].texels, 128u);
        EXPECT_EQ(map.lacking[0].empty, 128u);
        EXPECT_TRUE(map.lacking[0].is_whole());
        EXPECT_EQ(lacking_caster_text(map.lacking[0]), "box: the map lacks it (128 of 128 texels; it is empty there)");

        // Over the floor, the imported map lies 4 m behind.
        map = compare(scene, all, as_given(scene, floor_alone, view));
        EXPECT_EQ(map.numbers.extra + map.numbers.missed, 0u);
        EXPECT_EQ(map.numbers.both, 64u * 64u);
        EXPECT_EQ(map.numbers.farther, 14u * 6u) << "without the outline";
        EXPECT_NEAR(map.numbers.metres.max, 4, 2e-4);
        EXPECT_EQ(map.numbers.metres.median, 0);
        EXPECT_FALSE(map.numbers.gate.most);
        ASSERT_EQ(map.lacking.size(), 1u);
        EXPECT_EQ(map.lacking[0].path, "box");
        EXPECT_EQ(map.lacking[0].farther, 128u);

        // The scene lacks what the imported map holds.
        map = compare(scene, nothing, as_given(scene, no_floor, view));
        EXPECT_EQ(map.numbers.missed, 128u);
        EXPECT_EQ(map.numbers.unexplained.from, glm::ivec2(32, 24));
        EXPECT_TRUE(map.lacking.empty());
        map = compare(scene, floor_alone, as_given(scene, all, view));
        EXPECT_EQ(map.numbers.nearer, 128u);
        EXPECT_EQ(map.numbers.unexplained.from, glm::ivec2(32, 24));
        EXPECT_TRUE(map.lacking.empty());
    }
}

// Engines leave out casters whose shadows nobody sees. The map is then right, and the caster is still named.
TEST_F(MapComparisonTest, CastersThatWereNotDrawnCountInNoMap) {
    const Scene scene = floor_and_tall_box();
    Settings floor_alone = plain(), nothing = plain();
    floor_alone.objects["box"].cast = false;
    nothing.objects["floor"].cast = nothing.objects["box"].cast = false;
    const auto given = [&](const Settings& s, std::optional<std::vector<std::string>> drawn) {
        ImportedMaps maps = *as_given(scene, s, from_above());
        maps.drawn = {std::move(drawn)};
        return compare(scene, plain(), std::make_shared<const ImportedMaps>(std::move(maps)));
    };
    using Names = std::vector<std::string>;
    ComparedMap map = given(floor_alone, Names{"floor"});
    EXPECT_EQ(map.numbers.gate.text, "passed: the casters that were drawn there draw this map");
    EXPECT_EQ(map.numbers.farther, 0u);
    ASSERT_EQ(map.lacking.size(), 1u);
    EXPECT_FALSE(map.lacking[0].drawn);
    EXPECT_EQ(lacking_caster_text(map.lacking[0]),
              "box: the map lacks it (128 of 128 texels; it holds a surface behind there; it was not drawn there)");
    map = given(nothing, Names{});
    EXPECT_EQ(map.numbers.covered + map.numbers.extra, 0u);
    EXPECT_TRUE(map.numbers.gate.passed()) << map.numbers.gate.text;
    EXPECT_EQ(map.lacking.size(), 2u);
    // Casters that should be there come first.
    map = given(nothing, Names{"box"});
    ASSERT_EQ(map.lacking.size(), 2u);
    EXPECT_TRUE(map.lacking[0].drawn);
    EXPECT_EQ(map.lacking[0].path, "box");
    EXPECT_EQ(map.lacking[1].path, "floor") << "it has more texels, and was not drawn";
    // A caster that the bundle lists is missing from its map.
    map = given(floor_alone, Names{"box", "floor"});
    EXPECT_FALSE(map.numbers.gate.passed());
    ASSERT_EQ(map.lacking.size(), 1u);
    EXPECT_TRUE(map.lacking[0].drawn);
    // Nothing is known from names that the scene lacks.
    EXPECT_FALSE(given(floor_alone, Names{"floor", "Box"}).numbers.gate.passed());
    EXPECT_FALSE(given(floor_alone, std::nullopt).numbers.gate.passed());
    EXPECT_EQ(given(plain(), Names{"box", "floor"}).numbers.gate.text, "passed: the scene draws this map");
}

// A lamp sees the box's top at 8 m: a metre is 8 texels of 64 there.
TEST_F(MapComparisonTest, ALampSeesTheTopOfTheBox) {
    const Scene scene =
        test::grey_scene({{"floor", make_plane(30, 30)}, {"sheet", make_plane(2.06, 1.06), moved(1, 4, -0.5)}});
    Settings s = plain();
    s.lights[0].type = LightType::Spot;
    s.lights[0].distance = 12;
    s.lights[0].cone = 80;
    Settings floor_alone = s;
    floor_alone.objects["sheet"].cast = false;
    const ComparedMap map = compare(scene, s, as_given(scene, floor_alone, from_lamp()));
    EXPECT_EQ(map.numbers.farther, 14u * 6u);
    ASSERT_EQ(map.lacking.size(), 1u);
    EXPECT_EQ(map.lacking[0].texels, 16u * 8u);
    // The largest step along a ray is that of the sheet's far corner: 4 m along the axis.
    const double x = 15.5 / 32 * 0.5, y = 7.5 / 32 * 0.5;
    EXPECT_NEAR(map.numbers.metres.max, 4 * std::sqrt(1 + x * x + y * y), 2e-3);
    EXPECT_NEAR(map.numbers.texels.max, 4 / 0.125, 0.02) << "in texels at 8 m";
}

// Depths moved by a known length differ by that length, whatever the depth curve is.
TEST_F(MapComparisonTest, ADepthBiasIsMeasuredInMetres) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    constexpr double kBias = 0.05;
    for (const LightFit fit : {LightFit::Scene, LightFit::Lispsm})
        for (const LightType type : {LightType::Directional, LightType::Spot})
            for (const char* reversed : {"false", "true"}) {
                SCOPED_TRACE(testing::Message() << int(type) << " " << int(fit) << " " << reversed);
                Settings s = settings_with(plain(), {{"map.format", "d32f"}, {"map.reversed_z", reversed}});
                s.lights[0].type = type;
                s.lights[0].fit = fit;
                s.lights[0].cone = 60;
                if (type == LightType::Spot) s.lights[0].distance = 9;
                FrameRequest request{.width = 96, .height = 72, .outputs = {.shadow_map = true}};
                request.map_size = MapSize(48, 192);
                const FrameResult frame = renderer.render(scene, s, request);
                const LightView& view = frame.lights[0].views.at(0);
                FloatImage image = renderer.read_shadow_map(frame, 0, 0);
                const float far_depth = float(view.curve.convention.far_depth());
                std::vector<double> along_ray;
                for (int y = 0; y < image.height; ++y)
                    for (int x = 0; x < image.width; ++x) {
                        float& depth = image.data[std::size_t(y * image.width + x)];
                        if (depth == far_depth) continue;
                        const glm::dvec2 uv((x + 0.5) / image.width, 1 - (y + 0.5) / image.height);
                        const DepthCurve curve = view.curve.curve_at_row(uv.y);
                        const double z = curve.distance(depth);
                        const double moved = curve.depth(z + kBias);
                        if (moved < 0 || moved > 1) {
                            along_ray.push_back(0);
                            continue;
                        }
                        depth = float(moved);
                        along_ray.push_back(glm::length(view.position_ws(uv, z + kBias) - view.position_ws(uv, z)));
                    }
                std::ranges::sort(along_ray);
                const ComparedMap map = compare(scene, s, imported_maps({image}, ImportedViews{{view}, {}}));
                EXPECT_GT(map.numbers.both, 1000u);
                EXPECT_NEAR(map.numbers.metres.signed_median, along_ray[along_ray.size() / 2], 1e-4);
                EXPECT_NEAR(map.numbers.metres.max, along_ray.back(), 1e-3);
                EXPECT_TRUE(map.numbers.gate.missed && map.numbers.gate.extra);
                EXPECT_FALSE(map.numbers.gate.median);
                EXPECT_EQ(map.numbers.nearer + map.numbers.farther, 0u) << "bias is no other surface";
                EXPECT_TRUE(map.lacking.empty());
            }
}

// Polygon offset units are steps of a 16-bit map. With the engine's raster state the maps agree.
TEST_F(MapComparisonTest, PolygonOffsetIsDrawnWhereItIsKnown) {
    const Scene scene = floor_and_tall_box();
    const LightView view = from_above();
    const CasterRaster raster{.offset_factor = 1, .offset_units = 6, .cull = {}};
    const auto theirs = as_given(scene, plain(), view, 64, {raster});
    const ComparedMap unknown = compare(scene, plain(), theirs);
    const PolygonOffset unit = renderer.driver().offset[std::size_t(MapFormat::D16)];
    EXPECT_NEAR(unknown.numbers.depth.signed_median, 6 * unit.unit_depth, 1.01 / 65535);
    EXPECT_GE(unknown.numbers.steps.signed_median, 5.9);
    EXPECT_FALSE(unknown.numbers.gate.passed());
    EXPECT_TRUE(unknown.lacking.empty());
    const ComparedMap known =
        compare(scene, plain(), imported_maps(theirs->images, ImportedViews{{view}, {}}, {raster}));
    EXPECT_TRUE(known.numbers.gate.passed()) << known.numbers.gate.text;
    EXPECT_EQ(known.numbers.depth.max, 0);
}

// Without its top, the box leaves only its bottom on the floor.
TEST_F(MapComparisonTest, CullingIsThatOfTheImportedMap) {
    const Scene scene = floor_and_tall_box();
    const LightView view = from_above();
    for (const Cull cull : {Cull::Front, Cull::Back}) {
        const auto theirs = as_given(scene, plain(), view, 64, {{.cull = cull}});
        const ComparedMap known =
            compare(scene, plain(), imported_maps(theirs->images, ImportedViews{{view}, {}}, {{.cull = cull}}));
        EXPECT_TRUE(known.numbers.gate.passed()) << known.numbers.gate.text;
        EXPECT_TRUE(known.lacking.empty());
    }
    // A plane shows its front alone: culling front faces loses the floor.
    const ComparedMap unknown = compare(scene, plain(), as_given(scene, plain(), view, 64, {{.cull = Cull::Front}}));
    EXPECT_EQ(unknown.numbers.extra, 64u * 64u - 128u);
    ASSERT_FALSE(unknown.lacking.empty());
    EXPECT_EQ(unknown.lacking[0].path, "floor");
}

TEST_F(MapComparisonTest, MaskedCastersCanBeLeftOutOfBoth) {
    Scene scene = floor_and_tall_box();
    Material leaf = scene.materials[0];
    leaf.alpha = AlphaMode::Mask;
    leaf.alpha_cutoff = 0.5f;
    leaf.base_colour.a = 0.2f;  // a hole everywhere
    const int material = int(scene.materials.size());
    scene.materials.push_back(leaf);
    const int mesh = add_mesh(scene, "leaf", make_plane(1.06, 1.06), material);
    add_object(scene, "leaf", -1, mesh, moved(-2.5, 1, 2.5));
    finalise(scene);
    Scene solid = scene;
    solid.materials[std::size_t(material)].alpha = AlphaMode::Opaque;
    refresh(solid);
    const auto theirs = as_given(solid, plain(), from_above());
    const ComparedMap drawn = compare(scene, plain(), theirs);
    EXPECT_EQ(drawn.numbers.nearer, 8u * 8u) << "an engine that draws leaves as sheets";
    EXPECT_FALSE(drawn.numbers.gate.passed());
    const ComparedMap left_out = compare(scene, plain(), theirs, {.leaves_out_masked = true});
    EXPECT_EQ(left_out.numbers.masked, 10u * 10u) << "with a texel around";
    EXPECT_TRUE(left_out.numbers.gate.passed()) << left_out.numbers.gate.text;
}

TEST_F(MapComparisonTest, ReportsNameTheGateTheCastersAndTheBias) {
    const Scene scene = floor_and_tall_box();
    Settings lacks = plain();
    lacks.objects["box"].cast = false;
    ImportedMaps given = *as_given(scene, lacks, from_above());
    given.bias_known = false;
    const auto theirs = std::make_shared<const ImportedMaps>(given);
    const std::vector<ComparedMap> maps = compare_imported_maps(renderer, scene, plain(), {theirs}, 0);
    EXPECT_FALSE(all_pass_gate(maps));
    const std::string text = map_comparison_text(maps);
    for (const char* part : {"light 0", "64x64", "failed: 99 % of the depths lie within",
                             "box: the map lacks it (128 of 128 texels; it holds a surface behind there)"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    const auto json = map_comparison_json(maps).at(0);
    EXPECT_EQ(json["covered"], 4096);
    EXPECT_EQ(json["farther"], 84);
    EXPECT_EQ(json["gate"]["passed"], false);
    EXPECT_EQ(json["lacking"][0]["object"], "box");
    EXPECT_EQ(json["unexplained_box"], nullptr);

    // The difference stands right of both maps, with the box in the colour of the largest difference.
    const ByteImage sheet = map_comparison_sheet(maps, 64);
    const auto far_red = difference_colour(1, 1);
    std::size_t red = 0;
    for (std::size_t i = 0; i < sheet.data.size(); i += 4)
        red += std::equal(far_red.begin(), far_red.end(), sheet.data.begin() + std::ptrdiff_t(i));
    EXPECT_GE(red, 128u);
    EXPECT_LE(red, 160u) << "and in the scale";

    const MapBias bias = map_bias(renderer, scene, plain(), {theirs}, 0, {96, 72});
    EXPECT_NEAR(bias.texel_m.longest, 0.125, 1e-9);
    EXPECT_NEAR(bias.depth_per_m, 0.1, 1e-9);
    EXPECT_FALSE(bias.enough.empty());
    EXPECT_NE(map_bias_text(bias).find("the engine's bias is unknown"), std::string::npos);
    EXPECT_EQ(map_bias_json(bias)["engine_bias"], nullptr);
    EXPECT_EQ(map_bias_json(bias)["engine_bias_from"], nullptr);
    given.bias_known = true;
    const MapBias known = map_bias(renderer, scene, plain({{"bias.constant", "0.7"}}),
                                   {std::make_shared<const ImportedMaps>(given)}, 0, {96, 72});
    EXPECT_NE(map_bias_text(known).find("the engine's bias: bias.constant 0.7 texels; as the bundle states it"),
              std::string::npos)
        << map_bias_text(known);
    EXPECT_EQ(map_bias_json(known)["engine_bias_from"], "file");

    // Entered amounts count, whatever the file leaves out.
    given.bias_known = false;
    const MapBias entered = map_bias(renderer, scene, plain({{"bias.constant", "0.7"}, {"map.bundle_bias", "entered"}}),
                                     {std::make_shared<const ImportedMaps>(given)}, 0, {96, 72});
    EXPECT_NE(map_bias_text(entered).find("the engine's bias: bias.constant 0.7 texels; as entered"), std::string::npos)
        << map_bias_text(entered);
    EXPECT_EQ(map_bias_json(entered)["engine_bias_from"], "entered");
    EXPECT_EQ(map_bias_json(entered)["enough"], map_bias_json(known)["enough"]);
}

TEST_F(MapComparisonTest, LightsWithoutImportedMapsAreRefused) {
    const Scene scene = floor_and_tall_box();
    EXPECT_THROW(compare_imported_maps(renderer, scene, plain(), {}, 0), Error);
    EXPECT_THROW(compare_imported_maps(renderer, scene, plain(), {nullptr}, 0), Error);
    EXPECT_THROW(compare_imported_maps(renderer, scene, plain(), {as_given(scene, plain(), from_above())}, -1), Error);
    Settings off = plain();
    off.light_count = 0;
    EXPECT_THROW(compare_imported_maps(renderer, scene, off, {as_given(scene, plain(), from_above())}, 0), Error);
}

}  // namespace
}  // namespace si
