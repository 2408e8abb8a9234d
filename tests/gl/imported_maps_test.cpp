// Gives maps as images instead of drawing them: a map that is drawn, read back and given again changes no byte.
#include "renderer/bundle/imported_maps.h"

#include <filesystem>

#include "renderer/base/error.h"
#include "renderer/measure/measured_error.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/reference/ray_scenes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/box_scene.h"
#include "tests/support/hard_case.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class ImportedMapsTest : public FrameTest {
protected:
    FrameRequest request{.width = 96, .height = 72, .outputs = {.visibility = true}};

    /// Draws a light's maps and reads them back.
    std::shared_ptr<const ImportedMaps> read_back(const Scene& scene, const Settings& s, bool with_views,
                                                  std::optional<MapSize> size = std::nullopt) {
        FrameRequest maps = request;
        maps.outputs.shadow_map = true;
        maps.map_size = size;
        const FrameResult frame = renderer.render(scene, s, maps);
        const FittedLight& light = frame.lights.at(0);
        std::vector<FloatImage> images;
        for (std::size_t v = 0; v < light.views.size(); ++v)
            images.push_back(renderer.read_shadow_map(frame, 0, int(v)));
        if (!with_views) return imported_maps(std::move(images));
        return imported_maps(std::move(images), ImportedViews{light.views, light.chooser});
    }

    struct Drawn {
        ByteImage colour;
        FloatImage visibility;
        std::vector<Probe> probes;
        ErrorMetrics metrics;
        FrameResult frame;
    };
    Drawn draw(const Scene& scene, const Settings& s, std::shared_ptr<const ImportedMaps> maps,
               std::optional<MapSize> size = std::nullopt) {
        FrameRequest r = request;
        r.map_size = size;
        if (maps) r.imported = {maps};
        Drawn out;
        out.frame = renderer.render(scene, s, r);
        out.colour = renderer.read_colour(out.frame.colour);
        out.visibility = renderer.read_float(out.frame.visibility, 1);
        for (int y = 5; y < r.height; y += 23)
            for (int x = 7; x < r.width; x += 29) out.probes.push_back(renderer.probe(scene, s, r, x, y));
        ReferenceCache cache;
        out.metrics = measure_error(renderer, scene, s, r, 0, {}, cache).metrics;
        return out;
    }
    static void expect_equal(const Drawn& a, const Drawn& b) {
        EXPECT_EQ(different_pixels(a.colour, b.colour), 0u);
        EXPECT_EQ(differing_floats(a.visibility.data, b.visibility.data), 0u);
        ASSERT_EQ(a.probes.size(), b.probes.size());
        for (std::size_t i = 0; i < a.probes.size(); ++i) {
            ASSERT_EQ(a.probes[i].hit, b.probes[i].hit);
            if (!a.probes[i].hit) continue;
            const Probe::PerLight &p = a.probes[i].lights[0], &q = b.probes[i].lights[0];
            EXPECT_EQ(p.verdict, q.verdict);
            EXPECT_EQ(p.stored, q.stored);
            EXPECT_EQ(p.compared, q.compared);
            EXPECT_EQ(p.visibility, q.visibility);
            EXPECT_EQ(p.account.least.total(), q.account.least.total());
            ASSERT_EQ(p.taps.size(), q.taps.size());
            for (std::size_t t = 0; t < p.taps.size(); ++t) EXPECT_EQ(p.taps[t].stored, q.taps[t].stored);
        }
        EXPECT_EQ(a.metrics.artefacts, b.metrics.artefacts);
        EXPECT_EQ(a.metrics.false_shadow, b.metrics.false_shadow);
        EXPECT_EQ(a.metrics.false_light, b.metrics.false_light);
    }
};

Settings lit_by_kernel(LightType type, LightFit fit, const char* kernel) {
    Settings s = test::texel_settings(kernel, 128, 0.7);
    s.lights[0].type = type;
    s.lights[0].fit = fit;
    s.lights[0].cone = 80;
    if (type != LightType::Directional) s.lights[0].distance = 9;
    return s;
}

SI_TEST_IS(Slow, ImportedMapsTest, GivenMapsEqualDrawnOnes);
TEST_F(ImportedMapsTest, GivenMapsEqualDrawnOnes) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const auto& [type, fit] : {std::pair{LightType::Directional, LightFit::Scene},
                                    {LightType::Directional, LightFit::Lispsm},
                                    {LightType::Spot, LightFit::Scene},
                                    {LightType::Point, LightFit::Scene}})
        for (const char* kernel : {"hard", "pcss", "vsm"}) {
            SCOPED_TRACE(testing::Message() << int(type) << " " << int(fit) << " " << kernel);
            const Settings s = lit_by_kernel(type, fit, kernel);
            const Drawn drawn = draw(scene, s, nullptr);
            const Drawn given = draw(scene, s, read_back(scene, s, false));
            expect_equal(drawn, given);
            EXPECT_EQ(given.frame.lights[0].provider, MapProvider::Imported);
            EXPECT_EQ(given.frame.imported.size(), 1u);
            EXPECT_TRUE(drawn.frame.imported.empty());
            EXPECT_NE(map_pass(given.frame).reason.find("imported"), std::string::npos);
            EXPECT_EQ(map_pass(given.frame).draws, 0u);
        }
}

SI_TEST_IS(Slow, ImportedMapsTest, GivenMapsOfEachFormatEqualDrawnOnes);
TEST_F(ImportedMapsTest, GivenMapsOfEachFormatEqualDrawnOnes) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const char* format : {"d16", "d24", "d32f", "colour"})
        for (const char* reversed : {"false", "true"}) {
            SCOPED_TRACE(std::string(format) + " reversed " + reversed);
            const Settings s = settings_with(lit_by_kernel(LightType::Directional, LightFit::Scene, "pcf3"),
                                             {{"map.format", format}, {"map.reversed_z", reversed}});
            expect_equal(draw(scene, s, nullptr), draw(scene, s, read_back(scene, s, false)));
        }
}

TEST_F(ImportedMapsTest, GivenViewsReplaceTheFit) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    const Settings s = lit_by_kernel(LightType::Directional, LightFit::Scene, "pcf3");
    const auto maps = read_back(scene, s, true, MapSize(160, 90));
    const Drawn drawn = draw(scene, s, nullptr, MapSize(160, 90));
    Settings other = s;
    other.lights[0].fit = LightFit::Manual;
    other.lights[0].extent = 0.5;
    other.map.resolution = 32;
    const Drawn given = draw(scene, other, maps);
    EXPECT_EQ(given.frame.map_size, MapSize(160, 90));
    expect_equal(drawn, given);
}

// The view is derived from the float matrix alone.
SI_TEST_IS(Later, ImportedMapsTest, AViewOfAMatrixGivesTheSameShadows);
TEST_F(ImportedMapsTest, AViewOfAMatrixGivesTheSameShadows) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const auto& [type, fit] : {std::pair{LightType::Directional, LightFit::Scene},
                                    {LightType::Directional, LightFit::Lispsm},
                                    {LightType::Spot, LightFit::Scene}}) {
        const Settings s = lit_by_kernel(type, fit, "pcf3");
        const auto own = read_back(scene, s, true);
        ImportedViews views = *own->views;
        for (LightView& view : views.views)
            view = view_of_matrix(glm::dmat4(glm::mat4(view.clip_from_relative(glm::dvec3(0)))), view.curve.convention);
        const Drawn drawn = draw(scene, s, nullptr), given = draw(scene, s, imported_maps(own->images, views));
        EXPECT_LE(differing_values(drawn.visibility, given.visibility, 0.01f), drawn.visibility.data.size() / 200)
            << int(type) << " " << int(fit);
    }
}

// A map may hold casters that the scene lacks.
TEST_F(ImportedMapsTest, GivenMapsNeedNoCaster) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    Settings s = lit_by_kernel(LightType::Directional, LightFit::Scene, "hard");
    const auto maps = read_back(scene, s, true);
    const FloatImage drawn = draw(scene, s, nullptr).visibility;
    for (const Node& node : scene.nodes) s.objects[node.path].cast = false;
    FrameRequest r = request;
    r.imported = {maps};
    const FrameResult frame = renderer.render(scene, s, r);
    EXPECT_TRUE(frame.lights[0].casts);
    EXPECT_EQ(differing_floats(drawn.data, renderer.read_float(frame.visibility, 1).data), 0u);
}

class DrawnByGivenViews : public ImportedMapsTest {
protected:
    /// Draws maps as the settings say, and again with their views given under settings that fit another map.
    /// @param raster raster state that stands for what `s` says of polygon offset and culling
    void expect_equal_maps(const Scene& scene, const Settings& s, std::optional<CasterRaster> raster = {},
                           MapSize size = 128) {
        const auto own = read_back(scene, s, true, size);
        Settings other = s;
        other.lights[0].fit = LightFit::Manual;
        other.lights[0].extent = 0.5;
        other.map.resolution = 32;
        std::vector<CasterRaster> states;
        if (raster) {
            other.bias.raster_slope = other.bias.raster_units = other.bias.raster_clamp = 0;
            other.caster.cull = Cull::None;
            states.assign(own->images.size(), *raster);
        }
        FrameRequest r = request;
        r.outputs.shadow_map = true;
        r.imported = {drawn_maps(*own->views, size, states)};
        const FrameResult frame = renderer.render(scene, other, r);
        EXPECT_EQ(frame.map_size, size);
        EXPECT_EQ(frame.lights[0].provider, MapProvider::Drawn);
        EXPECT_EQ(map_pass(frame).reason.find("imported"), std::string::npos);
        for (std::size_t v = 0; v < own->images.size(); ++v)
            EXPECT_EQ(differing_floats(own->images[v].data, renderer.read_shadow_map(frame, 0, int(v)).data), 0u) << v;
    }
};

TEST_F(DrawnByGivenViews, EveryLightsMapsEqualTheOwnOnes) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const auto& [type, fit] : {std::pair{LightType::Directional, LightFit::Scene},
                                    {LightType::Directional, LightFit::Lispsm},
                                    {LightType::Spot, LightFit::Scene},
                                    {LightType::Point, LightFit::Scene}})
        for (const char* reversed : {"false", "true"}) {
            SCOPED_TRACE(testing::Message() << int(type) << " " << int(fit) << " reversed " << reversed);
            const Settings s = settings_with(lit_by_kernel(type, fit, "pcf3"), {{"map.reversed_z", reversed}});
            expect_equal_maps(scene, s);
            expect_equal_maps(scene, s, {}, MapSize(64, 256));
        }
    Settings cascades = lit_by_kernel(LightType::Directional, LightFit::View, "pcf3");
    set_setting(cascades, "light.cascades", "3");
    set_setting(cascades, "light.near_far", "pancaking");
    expect_equal_maps(scene, cascades);
}

TEST_F(DrawnByGivenViews, RasterStateEqualsThatOfTheSettings) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const char* reversed : {"false", "true"})
        for (const auto& [type, fit] :
             {std::pair{LightType::Directional, LightFit::Lispsm}, {LightType::Spot, LightFit::Scene}}) {
            Settings s = settings_with(lit_by_kernel(type, fit, "pcf3"), {{"map.reversed_z", reversed},
                                                                          {"map.format", "d16"},
                                                                          {"bias.raster_slope", "2.5"},
                                                                          {"bias.raster_units", "7"},
                                                                          {"caster.cull", "front"}});
            const double sign = s.map.reversed_z ? -1 : 1;
            expect_equal_maps(scene, s,
                              CasterRaster{.offset_factor = 2.5 * sign, .offset_units = 7 * sign, .cull = Cull::Front});
        }
}

// An engine's map may run from right to left, so that OpenGL sees the opposite winding.
TEST_F(DrawnByGivenViews, AMirroredMapIsTheMirroredImage) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    for (const Cull culled : {Cull::None, Cull::Back, Cull::Front}) {
        Settings s = lit_by_kernel(LightType::Directional, LightFit::Scene, "hard");
        s.caster.cull = culled;
        const auto own = read_back(scene, s, true, 128);
        ImportedViews views = *own->views;
        EXPECT_FALSE(is_mirrored(views.views[0]));
        EXPECT_EQ(culled_faces(culled, false, views.views[0]), culled);
        glm::dmat4 flip(1.0);
        flip[1][1] = -1;
        views.views[0] =
            view_of_matrix(flip * views.views[0].clip_from_relative(glm::dvec3(0)), views.views[0].curve.convention);
        EXPECT_TRUE(is_mirrored(views.views[0]));
        EXPECT_EQ(culled_faces(culled, true, views.views[0]), culled);
        EXPECT_EQ(culled_faces(culled, false, views.views[0]) == culled, culled == Cull::None);
        s.caster.cull = Cull::None;
        FrameRequest r = request;
        r.outputs.shadow_map = true;
        r.imported = {drawn_maps(views, 128, {CasterRaster{.cull = culled}})};
        const FloatImage drawn = renderer.read_shadow_map(renderer.render(scene, s, r), 0, 0);
        std::size_t differ = 0, covered = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) {
                const float a = own->images[0].at(x, y), b = drawn.at(x, 127 - y);
                covered += a < 1;
                differ += std::abs(a - b) > 1e-5f;
            }
        // A box without its front faces, and without a floor, still has its back.
        EXPECT_GT(covered, 100u) << int(culled);
        EXPECT_LE(differ, covered / 50) << int(culled) << " of " << covered;
    }
}

// An engine's shader may move casters away from the light before they are drawn.
TEST_F(DrawnByGivenViews, CastersThatAreMovedLieWhereTheyAreMovedTo) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    constexpr double kShift = 0.125, kGrazing = 0.5;
    for (const auto& [type, reversed] :
         {std::pair{LightType::Directional, "false"}, {LightType::Directional, "true"}, {LightType::Spot, "false"}}) {
        SCOPED_TRACE(testing::Message() << int(type) << " reversed " << reversed);
        const Settings s = settings_with(lit_by_kernel(type, LightFit::Scene, "hard"),
                                         {{"map.reversed_z", reversed}, {"map.format", "d32f"}});
        const ImportedViews views = *read_back(scene, s, true, 128)->views;
        const LightView& view = views.views[0];
        const glm::dvec3 away = -view.axes[2];
        const auto drawn = [&](const Scene& casters, CasterShift shift) {
            ImportedViews moving = views;
            moving.views[0].caster_shift = shift;
            FrameRequest r = request;
            r.outputs.shadow_map = true;
            r.imported = {drawn_maps(moving, 128)};
            return renderer.read_shadow_map(renderer.render(casters, s, r), 0, 0);
        };
        // All casters moved by one length: equal to a scene whose objects lie there.
        Scene moved = scene;
        moved.placement[3] += glm::dvec4(kShift * away, 0);
        refresh(moved);
        const FloatImage by_shader = drawn(scene, {kShift}), by_hand = drawn(moved, {});
        std::size_t differ = 0;
        for (std::size_t i = 0; i < by_hand.data.size(); ++i)
            differ += std::abs(by_shader.data[i] - by_hand.data[i]) > 1e-5f;
        EXPECT_LE(differ, by_hand.data.size() / 1000);
        if (type == LightType::Spot) continue;
        // Parallel rays: each surface recedes by the closed form of its normal.
        const FloatImage rest = drawn(scene, {}), slanted = drawn(scene, {kShift, kGrazing});
        std::size_t covered = 0, floor = 0, other = 0;
        for (std::size_t i = 0; i < rest.data.size(); ++i) {
            if (rest.data[i] == float(view.curve.convention.far_depth())) continue;
            ++covered;
            const double by = view.curve.distance(slanted.data[i]) - view.curve.distance(rest.data[i]);
            const auto is_normal = [&](const glm::dvec3& normal) {
                return std::abs(by - kShift - kGrazing * (1 - std::abs(glm::dot(normal, away)))) < 1e-4;
            };
            floor += is_normal({0, 1, 0});
            other += is_normal({1, 0, 0}) || is_normal({0, 0, 1});
        }
        EXPECT_GT(floor, covered / 2);
        EXPECT_GT(other, covered / 100);
        // A top that recedes may end before a side, in a strip along the edge.
        EXPECT_GE(floor + other, covered * 9 / 10) << "of " << covered;
    }
}

// Casters that an engine moves away from the light have a bias. Probe and overlay count it by the triangle's normal.
SI_TEST_IS(Later, DrawnByGivenViews, MovedCastersCountAsBias);
TEST_F(DrawnByGivenViews, MovedCastersCountAsBias) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    constexpr CasterShift kShift{.all_m = 0.04, .grazing_m = 0.3};
    for (const auto& [type, reversed] : {std::pair{LightType::Directional, "false"},
                                         {LightType::Directional, "true"},
                                         {LightType::Spot, "false"},
                                         {LightType::Spot, "true"}}) {
        SCOPED_TRACE(testing::Message() << int(type) << " reversed " << reversed);
        const Settings s = settings_with(lit_by_kernel(type, LightFit::Scene, "pcf3"),
                                         {{"map.reversed_z", reversed}, {"bias.kind", "constant"}});
        ImportedViews views = *read_back(scene, s, true, 128)->views;
        const glm::dvec3 axis = views.views[0].axes[2];
        FrameRequest rest = request, moved = request;
        rest.imported = {drawn_maps(views, 128)};
        views.views[0].caster_shift = kShift;
        moved.imported = {drawn_maps(views, 128)};
        const FloatImage slack_at_rest = overlay_values(scene, s, "bias-slack", rest),
                         slack_moved = overlay_values(scene, s, "bias-slack", moved);
        int compared = 0, grazing = 0;
        for (int y = 3; y < request.height; y += 7)
            for (int x = 3; x < request.width; x += 7) {
                const Probe at_rest = renderer.probe(scene, s, rest, x, y), p = renderer.probe(scene, s, moved, x, y);
                const std::size_t i = 4 * (std::size_t(y) * std::size_t(request.width) + std::size_t(x));
                // No number where the surface does not face the light, or lies outside the map.
                if (!p.hit || !std::isfinite(slack_moved.data[i])) continue;
                const BiasBreakdown &a = p.lights[0].account, &before = at_rest.lights[0].account;
                const double cosine = std::abs(glm::dot(p.lights[0].point.geometric, axis));
                const double along_m = kShift.all_m + kShift.grazing_m * (1 - cosine);
                ASSERT_EQ(before.raster, 0);
                const double away = a.curve.convention.reversed ? -1 : 1;
                EXPECT_NEAR(away * a.raster,
                            a.curve.depth(a.receiver.own_m + along_m) - a.curve.depth(a.receiver.own_m), 1e-12);
                EXPECT_DOUBLE_EQ(a.least.total(), before.least.total()) << "the need is that of the plane";
                const double gained =
                    a.amount(a.equivalent_depth()).texels - before.amount(before.equivalent_depth()).texels;
                EXPECT_NEAR(slack_moved.data[i] - slack_at_rest.data[i], gained, 1e-3 * (1 + gained));
                ++compared;
                grazing += cosine < 0.9;
            }
        EXPECT_GT(compared, 30);
        EXPECT_GT(grazing, 3);
    }
}

TEST_F(ImportedMapsTest, BadImportsAreRefused) {
    const Scene scene = test::floor_and_box(10, {1.5, 1, 2}, 0.4);
    const Settings s = lit_by_kernel(LightType::Point, LightFit::Scene, "hard");
    EXPECT_THROW(imported_maps({}), Error);
    EXPECT_THROW(imported_maps({FloatImage{2, 2, 1, {0, 0, 0}}}), Error);
    EXPECT_THROW(imported_maps({FloatImage{1, 1, 1, {0}}, FloatImage{2, 1, 1, {0, 0}}}), Error);
    EXPECT_THROW(imported_maps({FloatImage{1, 1, 1, {0}}}, ImportedViews{}), Error);
    EXPECT_THROW(imported_maps({FloatImage{1, 1, 1, {0}}}, std::nullopt, std::vector<CasterRaster>(2)), Error);
    EXPECT_THROW(drawn_maps(ImportedViews{}, 16), Error);
    EXPECT_THROW(drawn_maps(ImportedViews{{LightView{}}, {}}, 0), Error);
    EXPECT_THROW(drawn_maps(ImportedViews{{LightView{}}, {}}, 16, std::vector<CasterRaster>(2)), Error);
    FrameRequest r = request;
    r.imported = {imported_maps({FloatImage{1, 1, 1, {0}}})};
    EXPECT_THROW(renderer.render(scene, s, r), Error) << "six faces need six images";
    r.imported = {};
    renderer.render(scene, s, r);
    const Settings reversed =
        settings_with(lit_by_kernel(LightType::Spot, LightFit::Scene, "hard"), {"map.reversed_z=true"});
    r.imported = {read_back(scene, lit_by_kernel(LightType::Spot, LightFit::Scene, "hard"), true)};
    EXPECT_THROW(renderer.render(scene, reversed, r), Error) << "the convention of the views differs";
}

}  // namespace
}  // namespace si
