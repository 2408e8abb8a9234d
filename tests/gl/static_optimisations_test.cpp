// Tests cached depths of static casters: texels and pictures equal those of maps drawn whole, and counts report the
// skipped casters.
#include <algorithm>
#include <filesystem>

#include "renderer/inspect/effects.h"
#include "renderer/measure/optimisation_times.h"
#include "renderer/scene/animation.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/missing_reason.h"
#include "tests/support/traits.h"

namespace si {
namespace {

/// Adds small boxes around the scene, so that moving casters change neither the scene's bounds nor the views of its
/// maps.
void fence(Scene& scene) {
    const Bounds b = scene.bounds;
    const glm::dvec3 half = 0.55 * (b.hi - b.lo) + 0.02 * b.radius();
    const int post = add_mesh(scene, "Post", make_box(glm::dvec3(1)), -1);
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 at = b.centre() + half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        add_object(scene, "Post", -1, post,
                   moved(at.x, at.y, at.z) * scaled(0.005 * b.radius(), 0.005 * b.radius(), 0.005 * b.radius()));
    }
    finalise(scene);
}

/// Makes a floor, many static balls, and a moving one. Triangles: 2, 40 times a ball's, 8 times a post's.
Scene many_balls() {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    const int ball = add_mesh(scene, "Ball", make_sphere(0.5), grey);
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(20, 20), grey));
    for (int i = 0; i < 40; ++i) add_object(scene, "Ball", -1, ball, moved(2 * (i % 8) - 7, 0.5, 2 * (i / 8) - 4));
    add_object(scene, "Mover", -1, ball, moved(0, 1.5, 0));
    finalise(scene);
    fence(scene);
    return scene;
}

Node& node_named(Scene& scene, const char* name) {
    return *std::ranges::find_if(scene.nodes, [&](const Node& n) { return n.name == name; });
}

void move_by(Scene& scene, Node& node, double x, double y, double z) {
    node.local[3] += glm::dvec4(x, y, z, 0);
    refresh(scene);
}

Settings small_maps(const Scene& scene, const Sets& sets) {
    Settings s = settings_for(scene, sets);
    s.map.resolution = 200;  // not divisible by cells
    return s;
}

class StaticOptimisationsTest : public FrameTest {
protected:
    Renderer whole;  ///< renderer without the static cache

    static FrameRequest asked(OptimisationSet forced = {}) {
        FrameRequest request{.width = 64, .height = 36, .forced = forced};
        request.outputs.shadow_map = true;
        return request;
    }
    static const PartInfo* static_part(const FrameResult& f) {
        const PassInfo& pass = map_pass(f);
        const auto part =
            std::ranges::find_if(pass.parts, [](const PartInfo& p) { return p.name.starts_with("static casters"); });
        return part == pass.parts.end() ? nullptr : &*part;
    }
    static ByteImage picture_by(Renderer& by, const Scene& scene, const Settings& s, const FrameRequest& request) {
        return by.read_colour(by.render(scene, s, request).colour);
    }
    /// Draws with and without the static cache. @returns the frame with the cache
    FrameResult expect_the_same(const Scene& scene, const Settings& s, const std::string& what) {
        const FrameResult kept = renderer.render(scene, s, asked());
        const std::vector<float> texels = map_texels(renderer, kept);
        const ByteImage picture = renderer.read_colour(kept.colour);
        FrameRequest request = asked({Optimisation::StaticCasterCache});
        const FrameResult all = whole.render(scene, s, request);
        EXPECT_EQ(differing_floats(texels, map_texels(whole, all)), 0u) << what << ": texels";
        EXPECT_EQ(different_pixels(picture, whole.read_colour(all.colour)), 0u) << what << ": picture";
        return kept;
    }
    static bool is_kept(const FrameResult& f) { return static_part(f) && static_part(f)->state == PassState::Cached; }
};

const std::vector<Sets>& kinds() {
    static const std::vector<Sets> all = {
        {{"light.fit", "scene"}},
        {{"light.fit", "scene"}, {"map.format", "d16"}, {"filter.kernel", "pcf5"}},
        {{"light.fit", "scene"}, {"map.reversed_z", "true"}, {"bias.raster_slope", "2"}, {"bias.raster_units", "3"}},
        {{"light.type", "spot"}, {"filter.kernel", "vsm"}},
        {{"light.type", "point"}, {"map.format", "d24"}},
        {{"light.fit", "scene"}, {"light.near_far", "pancaking"}, {"map.blur_texels", "1"}},
        {{"light.fit", "scene"}, {"light.count", "2"}, {"light.1.type", "point"}, {"caster.cull", "front"}},
    };
    return all;
}

SI_TESTS_ARE(DriverIndependent, StaticOptimisationsTest);
SI_TESTS_ARE(Repeated, StaticOptimisationsTest);
SI_TEST_IS(Later, StaticOptimisationsTest, KeepEveryTexelOfBuiltInScenes);
TEST_F(StaticOptimisationsTest, KeepEveryTexelOfBuiltInScenes) {
    std::size_t next = 0;
    int kept = 0, frames = 0;
    for (const BuiltinScene& row : builtin_scenes()) {
        Scene scene = load_scene(std::string(row.key));
        if (scene.nodes.empty()) continue;
        fence(scene);
        for (int i = 0; i < 2; ++i, ++next) {
            const Settings s = small_maps(scene, kinds()[next % kinds().size()]);
            const std::size_t object = next * 7 % (scene.objects.size() - 8);
            Node& node = scene.nodes[std::size_t(scene.objects[object].node)];
            const double step = 0.01 * scene.bounds.radius();
            for (int frame = 0; frame < 5; ++frame, ++frames) {
                move_by(scene, node, step, frame % 2 ? step : -step, 0.5 * step);
                kept += is_kept(expect_the_same(scene, s, std::string(row.key) + ", " + std::to_string(next)));
            }
        }
    }
    EXPECT_GT(kept, frames / 4);
}

TEST_F(StaticOptimisationsTest, OnlyMovingCastersAreDrawnAfterTwoFrames) {
    Scene scene = many_balls();
    const std::uint64_t ball = scene.meshes[0].indices.size() / 3, all = 41 * ball + 2 + 8 * 12;
    for (const Sets& sets : {kinds()[0], kinds()[2]}) {
        const Settings s = small_maps(scene, sets);
        std::vector<std::uint64_t> drawn;
        for (int i = 0; i < 5; ++i) {
            move_by(scene, node_named(scene, "Mover"), 0.3, 0, 0.2);
            const FrameResult f = expect_the_same(scene, s, std::to_string(i));
            drawn.push_back(map_pass(f).triangles);
            if (i >= 3) {
                ASSERT_TRUE(is_kept(f));
                EXPECT_EQ(static_part(f)->left_out, 49u) << "the floor, 40 balls and the posts";
                EXPECT_EQ(static_part(f)->by, Optimisation::StaticCasterCache);
            }
        }
        EXPECT_EQ(drawn[0], all);
        EXPECT_EQ(drawn[1], all) << "movement is not yet known";
        EXPECT_EQ(drawn[3], ball);
        EXPECT_EQ(drawn[4], ball);
        for (const char* name : {"Ball", "Mover"}) {
            move_by(scene, node_named(scene, name), 0, 0.1, 0);
            const FrameResult f = expect_the_same(scene, s, name);
            // A former static caster is in the static map, which has to be drawn again. The other caster continues to
            // move.
            EXPECT_EQ(map_pass(f).triangles, name == std::string("Ball") ? all : 2 * ball) << name;
        }
    }
}

TEST_F(StaticOptimisationsTest, FacesWithoutMovingCastersAreNotDrawn) {
    Scene scene = many_balls();
    const Settings s = small_maps(scene, {{"light.type", "point"},
                                          {"light.distance", "3"},
                                          {"light.elevation", "90"},
                                          {"light.target_x", "-5"},
                                          {"filter.kernel", "pcf3"}});
    FrameResult f;
    for (int i = 0; i < 5; ++i) {
        move_by(scene, node_named(scene, "Mover"), 0.2, 0, 0.1);
        f = expect_the_same(scene, s, std::to_string(i));
    }
    ASSERT_TRUE(is_kept(f));
    int drawn = 0;
    for (const PartInfo& part : map_pass(f).parts)
        if (part.name.starts_with("face")) drawn += part.draws > 0;
    EXPECT_GE(drawn, 1);
    EXPECT_LE(drawn, 2) << "it lies to the light's side, in one face or on the edge of two";
}

TEST_F(StaticOptimisationsTest, KeepEveryTexelOfAnimatedModels) {
    const std::filesystem::path models = SI_SOURCE_DIR "/../shared/models";
    if (!std::filesystem::exists(models)) GTEST_SKIP() << test::kMissingReason << "../shared/models";
    for (const char* file :
         {"khr_Fox/glTF/Fox.gltf", "khr_BoxAnimated/glTF-Binary/BoxAnimated.glb",
          "khr_InterpolationTest/glTF-Binary/InterpolationTest.glb", "gen_skin_morph/skin_morph.gltf"}) {
        Scene scene = load_scene((models / file).string());
        const Bounds b = scene.bounds;
        const double size = 2 * b.radius();
        const int ball = add_mesh(scene, "Ball", make_sphere(1), -1);
        const int floor = add_mesh(scene, "Floor", make_plane(4 * size, 4 * size), -1);
        add_object(scene, "Floor", -1, floor, moved(b.centre().x, b.lo.y, b.centre().z));
        for (int i = 0; i < 8; ++i)
            add_object(scene, "Ball", -1, ball,
                       moved(b.centre().x + (i & 1 ? size : -size), b.lo.y + (i & 2 ? size : 0),
                             b.centre().z + (i & 4 ? size : -size)) *
                           scaled(0.2 * size, 0.2 * size, 0.2 * size));
        finalise(scene);
        fence(scene);
        int kept = 0;
        for (const Sets& sets : {kinds()[0], kinds()[4]})
            for (int i = 0; i < 5; ++i) {
                pose(scene, 0, 0.05 + 0.1 * i);
                kept += is_kept(expect_the_same(scene, small_maps(scene, sets), file + std::to_string(i)));
            }
        EXPECT_GE(kept, 2) << file;
    }
}

// A caster that stops is drawn on, until that has cost as much as drawing the static map again.
TEST_F(StaticOptimisationsTest, CastersThatStopMovingAreCached) {
    Scene scene = many_balls();
    const std::uint64_t ball = scene.meshes[0].indices.size() / 3;
    const Settings s = small_maps(scene, kinds()[0]);
    const auto move_balls = [&](int count) {
        for (Node& node : scene.nodes)
            if (node.name.starts_with("Ball") && count-- > 0) node.local[3].y += 0.01;
    };
    for (int i = 0; i < 4; ++i) {
        move_balls(20);
        move_by(scene, node_named(scene, "Mover"), 0.1, 0, 0);
    }
    std::vector<std::uint64_t> drawn;
    for (int i = 0; i < 12; ++i) {
        if (i < 4) move_balls(20);
        move_by(scene, node_named(scene, "Mover"), 0.1, 0, 0);
        drawn.push_back(map_pass(expect_the_same(scene, s, std::to_string(i))).triangles);
    }
    EXPECT_EQ(drawn[3], 21 * ball);
    EXPECT_EQ(drawn[5], 21 * ball) << "they may move again";
    EXPECT_EQ(drawn.back(), ball) << "they are static";
}

TEST_F(StaticOptimisationsTest, MasksAreDrawnOverMasks) {
    Scene scene = load_scene("stage");
    fence(scene);
    const Settings s = small_maps(scene, kinds()[0]);
    bool kept = false;
    for (int i = 0; i < 4; ++i) {
        const auto masked = std::ranges::find_if(scene.objects, [&](const Object& o) {
            const int m = scene.meshes[std::size_t(o.mesh)].material;
            return m >= 0 && scene.materials[std::size_t(m)].alpha == AlphaMode::Mask;
        });
        ASSERT_NE(masked, scene.objects.end());
        move_by(scene, scene.nodes[std::size_t(masked->node)], 0.05, 0, 0.02);
        kept = is_kept(expect_the_same(scene, s, std::to_string(i)));
    }
    EXPECT_TRUE(kept);
    for (Material& m : scene.materials) m.alpha_cutoff *= 0.7f;
    finalise(scene);
    EXPECT_FALSE(is_kept(expect_the_same(scene, s, "other cutoffs")));
}

TEST_F(StaticOptimisationsTest, AMovingCameraSeesCompleteMaps) {
    Scene scene = many_balls();
    for (const Sets& sets : {kinds()[0], kinds()[4]}) {
        Settings s = small_maps(scene, sets);
        s.camera.source = CameraSource::Manual;
        s.camera.distance = 6;
        s.camera.elevation = 30;
        s.camera.target_y = 0.5;
        FrameRequest few{.width = 64, .height = 36}, all = few;
        all.forced = {Optimisation::StaticCasterCache};
        int kept = 0;
        for (int i = 0; i < 12; ++i) {
            s.camera.azimuth += 25;
            s.camera.target_x = i % 5 - 2;
            if (i % 3) move_by(scene, node_named(scene, "Mover"), 0.4, 0, i % 2 ? 0.6 : -0.7);
            const FrameResult f = renderer.render(scene, s, few);
            kept += is_kept(f);
            EXPECT_EQ(different_pixels(renderer.read_colour(f.colour), picture_by(whole, scene, s, all)), 0u) << i;
        }
        EXPECT_GE(kept, 3);
    }
}

/// Settings under which a light has no static cache, and the reason that the plan must name.
struct UncachedLight {
    Sets sets;
    const char* mover;
    const char* reason;
};

TEST_F(StaticOptimisationsTest, LightsWithoutStaticCacheReportTheReason) {
    const UncachedLight all[] = {{{{"map.format", "colour"}, {"light.fit", "scene"}}, "Mover", "map.format"},
                                 {{{"map.format", "linear16"}, {"light.fit", "scene"}}, "Mover", "map.format"},
                                 {{{"light.fit", "scene"}}, "Post", "views changed"}};
    for (const UncachedLight& d : all) {
        Scene scene = many_balls();
        const Settings s = small_maps(scene, d.sets);
        for (int i = 0; i < 4; ++i) {
            move_by(scene, node_named(scene, d.mover), i % 2 ? 0.3 : -0.4, 0, 0);
            const FrameResult f = expect_the_same(scene, s, d.reason);
            if (i == 0) continue;
            ASSERT_TRUE(static_part(f)) << d.reason;
            EXPECT_EQ(static_part(f)->state, PassState::Skipped);
            EXPECT_NE(static_part(f)->reason.find(d.reason), std::string::npos) << static_part(f)->reason;
        }
    }
}

TEST_F(StaticOptimisationsTest, ReportTheirEffect) {
    Scene scene = many_balls();
    const Settings s = small_maps(scene, kinds()[0]);
    const auto reported = [&] {
        move_by(scene, node_named(scene, "Mover"), 0.2, 0, 0);
        const FrameResult f = renderer.render(scene, s, asked());
        return frame_effects(scene, s, f);
    };
    reported();
    reported();
    const char* name = "static casters in maps of light 0";
    const Effect drawn = effect_named(reported(), name), kept = effect_named(reported(), name);
    EXPECT_EQ(drawn.state, EffectState::Drawn) << drawn.reason;
    EXPECT_EQ(kept.state, EffectState::Cached) << kept.reason;
    EXPECT_EQ(kept.optimisation, Optimisation::StaticCasterCache);
    EXPECT_NE(kept.reason.find("49 casters are left out"), std::string::npos) << kept.reason;
}

/// Makes a scene whose ball moves by an animation of a second.
Scene animated_ball() {
    Scene scene = many_balls();
    auto rig = std::make_shared<Rig>();
    for (const Node& node : scene.nodes) rig->rest.push_back({.has_trs = node.name == "Mover"});
    const int mover = int(&node_named(scene, "Mover") - scene.nodes.data());
    rig->animations.push_back({.name = "To and fro",
                               .duration_s = 1,
                               .channels = {{.node = mover,
                                             .property = AnimatedProperty::Translation,
                                             .times_s = {0, 0.5f, 1},
                                             .values = {-3, 1.5f, 0, 3, 1.5f, 0, -3, 1.5f, 0}}}});
    scene.rig = std::move(rig);
    return scene;
}

TEST_F(StaticOptimisationsTest, MeasuredFramesMoveAndCacheStaticCasters) {
    const Scene scene = animated_ball();
    Settings s = small_maps(scene, kinds()[0]);
    s.scene.time = 0.9;  // crosses the end of the animation
    CachedFrames frames(scene, s, asked(), Optimisation::StaticCasterCache);
    for (int i = 0; i < 4; ++i) {
        frames.draw({});
        frames.draw({Optimisation::StaticCasterCache});
    }
    ByteImage before;
    for (int i = 0; i < 4; ++i) {
        const FrameResult kept = frames.draw({});
        EXPECT_TRUE(is_kept(kept));
        const std::uint64_t triangles = map_pass(kept).triangles;
        const ByteImage picture = renderer.read_colour(kept.colour);
        const FrameResult all = frames.draw({Optimisation::StaticCasterCache});
        EXPECT_GT(map_pass(all).triangles, 10 * triangles);
        EXPECT_EQ(different_pixels(picture, renderer.read_colour(all.colour)), 0u) << "they are of one moment";
        if (i > 0) {
            EXPECT_GT(different_pixels(picture, before), 0u) << "nothing moved";
        }
        before = picture;
    }
}

SI_TEST_IS(Later, StaticOptimisationsTest, AreMeasuredOnlyInScenesThatMove);
TEST_F(StaticOptimisationsTest, AreMeasuredOnlyInScenesThatMove) {
    const Scene moving = animated_ball(), still = many_balls();
    const auto measured = [&](const Scene& scene, const Settings& s) {
        Renderer again;  // a renderer that has seen no movement
        const FrameResult frame = again.render(scene, s, asked());
        const std::vector<Effect> effects = frame_effects(scene, s, frame);
        const auto reported = std::ranges::find_if(
            effects, [](const Effect& e) { return e.optimisation == Optimisation::StaticCasterCache && !e.part; });
        EXPECT_NE(reported, effects.end());
        if (reported == effects.end()) return std::pair(Effect{}, std::optional<Spread>());
        const std::vector<Optimisation> named = optimisations_of(effects);
        EXPECT_TRUE(std::ranges::count(named, Optimisation::StaticCasterCache) == 1);
        const SavedTimes times = measure_saved_times(again, scene, s, asked(), named, 5);
        const Spread* ms = times.saved_ms(*reported);
        return std::pair(*reported, ms ? std::optional(*ms) : std::nullopt);
    };
    Settings s = small_maps(moving, kinds()[0]);
    const auto [of_moving, ms] = measured(moving, s);
    EXPECT_NE(of_moving.reason.find("Nothing has moved since the frame before"), std::string::npos) << of_moving.reason;
    ASSERT_TRUE(ms);
    EXPECT_EQ(ms->samples, 5);
    EXPECT_LE(ms->median_low, ms->median);
    EXPECT_GE(ms->median_high, ms->median);
    const auto [of_still, none] = measured(still, s);
    EXPECT_NE(of_still.reason.find("Nothing moves in the scene"), std::string::npos) << of_still.reason;
    EXPECT_FALSE(none) << "it is never estimated";
    s.scene.animation = -1;
    EXPECT_FALSE(measured(moving, s).second);
}

}  // namespace
}  // namespace si
