// Tests skipped casters of maps: the texels stay equal, and counts show the skipped work.
#include <cmath>

#include "renderer/optimisations/optimisations.h"
#include "renderer/scenes/shapes.h"
#include "tests/gl/frame_fixture.h"
#include "tests/support/combinations.h"
#include "tests/support/missing_reason.h"
#include "tests/support/shared_models.h"
#include "tests/support/traits.h"

namespace si {
namespace {

class CasterOptimisationsTest : public FrameTest {
protected:
    FrameResult frame(const Scene& scene, const Settings& s, OptimisationSet forced = {}) {
        FrameRequest request{.width = 16, .height = 9, .force = true, .forced = forced};
        request.outputs = {.colour = false, .shadow_map = true};
        return renderer.render(scene, s, request);
    }
    std::vector<float> texels(const FrameResult& drawn) { return map_texels(renderer, drawn); }
    /// Compares every texel of every map with each optimisation forced.
    void expect_one_map(const Scene& scene, const Sets& sets, const std::string& what) {
        Settings s = settings_for(scene, sets);
        s.map.resolution = std::min(s.map.resolution, 512);
        const std::vector<float> saved = texels(frame(scene, s));
        for (const Optimisation by :
             {Optimisation::CasterBackFaces, Optimisation::CasterCulling, Optimisation::CasterFragments})
            EXPECT_EQ(differing_floats(saved, texels(frame(scene, s, {by}))), 0u)
                << what << (sets.empty() ? "" : ", " + sets[0].second) << ", " << row_of(by).key << " forced";
    }
};

const std::vector<Sets>& kinds_of_maps() {
    static const std::vector<Sets> all = {
        {},
        {{"light.elevation", "90"}, {"map.format", "d16"}},
        {{"light.azimuth", "33"}, {"light.elevation", "31"}, {"map.reversed_z", "true"}},
        {{"light.type", "spot"}},
        {{"light.type", "point"}, {"map.format", "colour"}},
        {{"light.type", "point"}, {"map.reversed_z", "true"}, {"light.range", "6"}},
        {{"light.cascades", "4"}, {"light.near_far", "pancaking"}},
        {{"light.near_far", "casters"}, {"bias.raster_slope", "2"}},
        {{"light.fit", "lispsm"}},
        {{"light.count", "3"}, {"light.type", "spot"}, {"map.format", "linear16"}},
    };
    return all;
}

Scene displaced_by(Scene scene, const glm::dmat4& by) {
    for (Node& node : scene.nodes)
        if (node.parent < 0) node.local = by * node.local;
    refresh(scene);
    return scene;
}

SI_TESTS_ARE(DriverIndependent, CasterOptimisationsTest);
SI_TESTS_ARE(Repeated, CasterOptimisationsTest);
SI_TEST_IS(Slow, CasterOptimisationsTest, KeepEveryTexelOfBuiltInScenes);
TEST_F(CasterOptimisationsTest, KeepEveryTexelOfBuiltInScenes) {
    for (const BuiltinScene& row : builtin_scenes())
        for (const Sets& sets : kinds_of_maps())
            expect_one_map(load_scene(std::string(row.key)), sets, std::string(row.key));
}

SI_TEST_IS(Later, CasterOptimisationsTest, KeepEveryTexelOfMovedMirroredAndShearedScenes);
TEST_F(CasterOptimisationsTest, KeepEveryTexelOfMovedMirroredAndShearedScenes) {
    glm::dmat4 sheared = moved(115, 0, 40) * scaled(-1, 1.3, 1);
    sheared[1][0] = 0.4;
    for (const Sets& sets : kinds_of_maps()) {
        expect_one_map(displaced_by(load_scene("boxes"), sheared), sets, "boxes mirrored and sheared");
        expect_one_map(displaced_by(load_scene("figures"), moved(115, 0, 0)), sets, "figures 115 m away");
    }
    expect_one_map(Scene{}, {}, "an empty scene");
}

SI_TEST_IS(Product, CasterOptimisationsTest, KeepEveryTexelOfRealModels);
SI_TEST_IS(Later, CasterOptimisationsTest, KeepEveryTexelOfRealModels);
TEST_F(CasterOptimisationsTest, KeepEveryTexelOfRealModels) {
    const std::vector<test::SharedModel> models = test::shared_models();
    if (models.empty()) GTEST_SKIP() << test::kMissingReason << "../shared/models";
    for (const test::SharedModel& model : test::portion(models, 4)) {
        std::optional<Scene> scene;
        try {
            scene = load_scene(model.file.string());
        } catch (const std::exception& error) {
            EXPECT_TRUE(model.may_be_refused) << error.what();
            continue;
        }
        for (const Sets& sets : {kinds_of_maps()[0], kinds_of_maps()[2], kinds_of_maps()[5]})
            expect_one_map(*scene, sets, model.file.filename().string());
    }
}

/// Makes a floor with a ball and a distant ball.
Scene two_balls() {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    const int ball = add_mesh(scene, "Ball", make_sphere(1), grey);
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(40, 40), grey));
    add_object(scene, "Near", -1, ball, moved(3, 1, 0));
    add_object(scene, "Far", -1, ball, moved(-9, 1, 0));
    finalise(scene);
    return scene;
}

TEST_F(CasterOptimisationsTest, CastersOutsideAFaceAreNotDrawn) {
    const Scene scene = two_balls();
    const Settings s = settings_for(scene, {{"light.type", "point"},
                                            {"light.target_y", "1"},
                                            {"light.target_z", "-1"},
                                            {"light.azimuth", "0"},
                                            {"light.elevation", "0"},
                                            {"light.distance", "1"}});
    const std::uint64_t ball = scene.meshes[0].indices.size() / 3;
    const PassInfo saved = map_pass(frame(scene, s)), forced = map_pass(frame(scene, s, {Optimisation::CasterCulling}));
    ASSERT_EQ(saved.parts.size(), 7u) << "six faces, and the back faces of what is closed";
    ASSERT_EQ(forced.parts.size(), 7u);
    EXPECT_EQ(saved.parts[0].name, "face +x of light 0");
    EXPECT_EQ(saved.parts[0].left_out, 1u) << "the far ball lies behind";
    EXPECT_EQ(saved.parts[0].by, Optimisation::CasterCulling);
    EXPECT_EQ(saved.parts[2].draws, 0u) << "nothing is above the light";
    EXPECT_EQ(saved.parts[2].left_out, 3u);
    EXPECT_LE(saved.triangles, 3 * ball + 6 * 2) << "a ball may reach into a next face";
    EXPECT_LT(saved.triangles, forced.triangles / 2);
    EXPECT_EQ(forced.triangles, 6 * (2 * ball + 2));
    for (const PartInfo& p : forced.parts) EXPECT_EQ(p.left_out, 0u);
}

TEST_F(CasterOptimisationsTest, BackFacesOfClosedCastersAreNotDrawn) {
    const Scene scene = two_balls();
    const std::uint64_t ball = scene.meshes[0].indices.size() / 3;
    const auto triangles = [&](const Sets& sets, OptimisationSet forced) {
        return map_pass(frame(scene, settings_for(scene, sets), forced)).triangles;
    };
    EXPECT_EQ(triangles({}, {}), 2 * ball + 2);
    EXPECT_EQ(triangles({}, {Optimisation::CasterBackFaces}), 4 * ball + 2) << "the balls once more, by their backs";
    for (const auto& [key, value] : {std::pair{"caster.cull", "front"}, {"bias.raster_units", "3"}})
        EXPECT_EQ(triangles({{key, value}}, {Optimisation::CasterBackFaces}), 2 * ball + 2)
            << key << ": both sides, or the setting's";
}

/// Makes a mesh of two boxes, 1 m and 2 m high: a light can see the top of one edge-on and that of the other not.
Mesh make_two_heights() {
    std::vector<std::vector<glm::dvec3>> faces;
    for (const double height : {1.0, 2.0}) {
        const auto p = [&](int x, int y, int z) {
            return glm::dvec3(2 * height - 3 + 0.5 * x, 0.5 * height * (1 + y), 0.5 * z);
        };
        faces.insert(faces.end(), {{p(-1, -1, 1), p(1, -1, 1), p(1, 1, 1), p(-1, 1, 1)},
                                   {p(1, -1, -1), p(-1, -1, -1), p(-1, 1, -1), p(1, 1, -1)},
                                   {p(1, -1, 1), p(1, -1, -1), p(1, 1, -1), p(1, 1, 1)},
                                   {p(-1, -1, -1), p(-1, -1, 1), p(-1, 1, 1), p(-1, 1, -1)},
                                   {p(-1, 1, 1), p(1, 1, 1), p(1, 1, -1), p(-1, 1, -1)},
                                   {p(-1, -1, -1), p(1, -1, -1), p(1, -1, 1), p(-1, -1, 1)}});
    }
    return make_polygons("Two heights", faces);
}

TEST_F(CasterOptimisationsTest, AClosedCasterIsDrawnWholeIfOneOfItsParallelSidesIsEdgeOn) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    add_object(scene, "Boxes", -1, add_mesh(scene, "Boxes", make_two_heights(), grey), moved(100, 0, -40));
    finalise(scene);
    // The target is relative to the middle of the scene, which is 1 m above its lower sides.
    const auto with_backs = [&](const char* above_middle_m) {
        const Sets sets = {{"light.type", "spot"},  {"light.target_y", above_middle_m},
                           {"light.azimuth", "33"}, {"light.elevation", "0"},
                           {"light.distance", "9"}, {"light.cone", "60"}};
        const auto triangles = [&](OptimisationSet forced) {
            return map_pass(frame(scene, settings_for(scene, sets), forced)).triangles;
        };
        return triangles({Optimisation::CasterBackFaces}) - triangles({});
    };
    EXPECT_EQ(with_backs("0.5"), 24u) << "no side is edge-on: the optimisation draws fronts alone";
    EXPECT_EQ(with_backs("0"), 0u) << "the top of the low box is edge-on";
    EXPECT_EQ(with_backs("1"), 0u) << "the top of the high box is edge-on";
}

TEST_F(CasterOptimisationsTest, FlatCastersNotSeenEdgeOnNeedNoFragmentShader) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(9, 9), grey));
    const int box = add_mesh(scene, "Box", make_box(glm::dvec3(0.5)), grey);
    for (int i = 0; i < 3; ++i) add_object(scene, "Box", -1, box, moved(2.0 * i - 2, 0.6, 0) * turned(20 * i));
    add_object(scene, "Ball", -1, add_mesh(scene, "Ball", make_sphere(0.5, 48, 32), grey), moved(0, 1, 2));
    finalise(scene);
    const auto bare = [&](const Sets& sets, OptimisationSet forced) {
        std::uint64_t count = 0;
        const FrameResult drawn = frame(scene, settings_for(scene, sets), forced);
        for (const PartInfo& part : map_pass(drawn).parts)
            if (part.by == Optimisation::CasterFragments) count += part.left_out;
        return count;
    };
    const Sets slanted = {{"light.azimuth", "33"}, {"light.elevation", "40"}, {"light.fit", "scene"}};
    const auto with = [&](const char* key, const char* value) {
        Sets sets = slanted;
        sets.emplace_back(key, value);
        return sets;
    };
    // The floor's side begins at the map's side. A driver with few sub-pixel bits may leave stray triangles there.
    const std::uint64_t well_seen = bare(slanted, {});
    EXPECT_GE(well_seen, 3u) << "the boxes, no side of which is edge-on";
    EXPECT_LE(well_seen, 4u) << "and the floor; the ball has many sides";
    EXPECT_EQ(bare(slanted, {Optimisation::CasterFragments}), 0u);
    EXPECT_EQ(bare(with("light.elevation", "90"), {}), 1u) << "the boxes' walls are edge-on";
    EXPECT_EQ(bare(with("light.azimuth", "90.001"), {}), well_seen - 1) << "two walls of the first box are nearly so";
    EXPECT_EQ(bare(with("map.format", "colour"), {}), 0u) << "a fragment shader writes the map";
    EXPECT_EQ(bare(with("light.type", "spot"), {}), 0u) << "its rays are not parallel";
    for (const Sets& sets : {slanted, with("light.elevation", "90"), with("light.azimuth", "90.001")})
        expect_one_map(scene, sets, "flat casters");
}

// Drivers round both sides of a closed body. Rounding decides only texels whose centre lies on a silhouette: fewer
// than ten among four million texels of the agreed scene.
TEST_F(CasterOptimisationsTest, BackFacesChangeSilhouetteTexelsOnly) {
    for (const char* key : {"boxes", "figures"}) {
        const Scene scene = load_scene(key);
        Settings all = settings_for(scene, {{"caster.cull", "none"}, {"map.resolution", "2048"}});
        const FrameResult drawn = frame(scene, all);
        const std::vector<float> saved = texels(drawn);
        all.bias.raster_units = 1e-30;  // disables the skipping of back faces
        const std::vector<float> both = texels(frame(scene, all));
        std::size_t others = 0;
        double most = 0;
        for (std::size_t i = 0; i < saved.size(); ++i)
            if (saved[i] != both[i]) {
                ++others;
                most = std::max(most, std::abs(double(saved[i]) - both[i]));
            }
        EXPECT_LT(double(others), 1e-5 * double(saved.size())) << key;
        EXPECT_LT(most, 1e-4) << key;
    }
}

}  // namespace
}  // namespace si
