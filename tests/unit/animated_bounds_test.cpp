// Tests of fits over a whole animation: maps that stay unchanged during playback and hold all moving objects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/session/session.h"
#include "renderer/scene/animation.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/param.h"
#include "renderer/view/bounds/scene_shape.h"
#include "renderer/view/cameras/make_camera.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/support/traits.h"
#include "tests/unit/gltf_test_file.h"

namespace si {
namespace {

using test::GltfFile;
using test::Json;

constexpr int kTimes = 20;

/// Makes a floor and a box that is rotated by `key_values` about y, far from its axis.
Scene swinging_box(Interpolation how) {
    Scene scene;
    scene.name = "swinging box";
    const int grey = add_material(scene, "grey", {1, 1, 1});
    add_object(scene, "Floor", -1, add_mesh(scene, "floor", make_box({6, 0.1, 6}), grey), moved(0, -0.1, 0));
    add_object(scene, "Arm", -1, add_mesh(scene, "box", make_box({1, 1, 1}), grey), moved(0, 0, 0));
    scene.objects.back().instance = moved(4, 1, 0);
    finalise(scene);
    auto rig = std::make_shared<Rig>();
    for (const Node& node : scene.nodes) rig->rest.push_back({.has_trs = node.name == "Arm"});
    const int arm = int(scene.nodes.size()) - 1;
    const float half = std::sqrt(0.5f);
    // Midway it is farther along x and z than at either key.
    rig->animations.push_back({.name = "swing",
                               .duration_s = 1,
                               .channels = {{.node = arm,
                                             .property = AnimatedProperty::Rotation,
                                             .interpolation = how,
                                             .width = 4,
                                             .times_s = {0, 0.4f, 1},
                                             .values = {0, 0, 0, 1, 0, half, 0, half, 0, 1, 0, 0}}}});
    rig->animations.push_back({.name = "none", .duration_s = 0});
    scene.rig = std::move(rig);
    return scene;
}

/// Makes a triangle that grows by a morph target, in a file with a fixed light.
GltfFile growing_triangle() {
    GltfFile file;
    const int grown = file.floats({0, 0, 0, 4, 0, 0, 0, 0, -3}, "VEC3");
    Json primitive = {{"attributes", {{"POSITION", file.triangle_positions()}}}};
    primitive["targets"] = Json::array({{{"POSITION", grown}}});
    const int node = file.root({{"name", "leaf"}, {"mesh", file.mesh(primitive)}});
    file.json["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "spot"}, {"name", "lamp"}}}}}}};
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.root({{"name", "lamp"},
               {"translation", {1, 6, 2}},
               {"rotation", {-0.70711, 0, 0, 0.70711}},
               {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.json["animations"] = {
        {{"samplers", {{{"input", file.floats({0, 1, 2}, "SCALAR")}, {"output", file.floats({0, 1, 0}, "SCALAR")}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}}}}}};
    return file;
}

std::vector<std::pair<std::string, Scene>> moving_scenes() {
    std::vector<std::pair<std::string, Scene>> all;
    all.emplace_back("swinging", swinging_box(Interpolation::Linear));
    all.emplace_back("stepping", swinging_box(Interpolation::Step));
    all.emplace_back("growing", growing_triangle().load());
    for (const char* name : {"BoxAnimated", "Fox", "RiggedSimple", "AnimatedMorphCube"}) {
        const std::filesystem::path file = std::filesystem::path(SI_SOURCE_DIR) / "../shared/models" /
                                           (std::string("khr_") + name) / "glTF-Binary" / (std::string(name) + ".glb");
        if (std::filesystem::exists(file)) all.emplace_back(name, load_scene(file.string()));
    }
    return all;
}

Session session_at(const Scene& scene, double time_s, std::vector<std::string> sets) {
    sets.push_back("scene.time=" + std::to_string(time_s));
    return compose_session(plan_session({.scene = "moving", .sets = std::move(sets)}), scene);
}

double time_of(const Scene& scene, int i) {
    return scene.rig->animations[0].duration_s * i / (kTimes - 1);
}

/// Returns every number that affects the drawing of a light's maps.
std::vector<double> numbers_of(const std::vector<FittedLight>& lights) {
    std::vector<double> out;
    const auto add = [&](const auto& matrix, int columns, int rows) {
        for (int c = 0; c < columns; ++c)
            for (int r = 0; r < rows; ++r) out.push_back(matrix[c][r]);
    };
    for (const FittedLight& light : lights)
        for (const LightView& view : light.views) {
            add(view.clip_from_relative(light.map_origin), 4, 4);
            for (const glm::dvec3& v : {view.eye, light.map_origin, light.position})
                for (int k = 0; k < 3; ++k) out.push_back(v[k]);
            out.insert(out.end(), {view.curve.near, view.curve.far, view.half_extent()});
        }
    return out;
}

/// Returns the number of moving vertices outside a view or its depth range.
std::size_t count_outside(const Scene& scene, const FittedLight& light) {
    std::size_t count = 0;
    const LightView& view = light.views[0];
    const glm::dmat4 clip = view.clip_from_relative(light.map_origin);
    for (const Object& o : scene.objects) {
        if (o.animation_bounds.empty()) continue;
        for (const std::uint32_t i : scene.meshes[std::size_t(o.mesh)].indices) {
            const glm::dvec3 p(o.world * glm::dvec4(glm::dvec3(scene.meshes[std::size_t(o.mesh)].positions[i]), 1));
            const glm::dvec4 c = clip * glm::dvec4(p - light.map_origin, 1);
            const double least = view.curve.convention.zero_to_one ? 0 : -c.w;
            count += std::abs(c.x) > c.w || std::abs(c.y) > c.w || c.z < least || c.z > c.w;
        }
    }
    return count;
}

SI_TEST_IS(Repeated, AnimatedBounds, KeepMapsSteadyAroundMovingObjects);
TEST(AnimatedBounds, KeepMapsSteadyAroundMovingObjects) {
    for (const auto& [name, scene] : moving_scenes())
        for (const char* fit : {"casters", "scene"})
            for (const char* type : {"directional", "spot", "point"}) {
                SCOPED_TRACE(name + " " + fit + " " + type);
                const std::vector<std::string> sets{std::string("light.fit=") + fit, std::string("light.type=") + type};
                std::vector<std::string> over = sets;
                over.push_back("scene.fit_animation=on");
                std::vector<double> first;
                bool follows = false;
                for (int i = 0; i < kTimes; ++i) {
                    const Session session = session_at(scene, time_of(scene, i), over);
                    const auto lights = fit_lights(session.scene, session.settings);
                    if (i == 0) first = numbers_of(lights);
                    EXPECT_EQ(numbers_of(lights), first) << i;
                    EXPECT_EQ(lights[0].clipped_casters, 0) << i;
                    if (std::string_view(type) == "directional") {
                        EXPECT_EQ(count_outside(session.scene, lights[0]), 0u) << i;
                    }
                    const Session off = session_at(scene, time_of(scene, i), sets), start = session_at(scene, 0, sets);
                    follows |= numbers_of(fit_lights(off.scene, off.settings)) !=
                               numbers_of(fit_lights(start.scene, start.settings));
                }
                EXPECT_TRUE(follows) << "without the setting they follow the pose";
            }
}

// No wider than the moving parts: for a swinging box, the circle of its corner.
TEST(AnimatedBounds, EncloseEachTimeTightly) {
    const Scene scene = swinging_box(Interpolation::Linear);
    const Session session = session_at(scene, 0, {"scene.fit_animation=on"});
    const Bounds& animation_bounds = session.scene.objects[1].animation_bounds;
    const double corner = std::hypot(4.5, 0.5);
    Bounds all;
    for (int i = 0; i <= 1000; ++i) {
        Scene posed = scene;
        pose(posed, 0, i / 1000.0);
        all.add(posed.meshes[std::size_t(posed.objects[1].mesh)].bounds.transformed(posed.objects[1].world));
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(animation_bounds.lo[axis], all.lo[axis] + 1e-6) << axis;
        EXPECT_GE(animation_bounds.hi[axis], all.hi[axis] - 1e-6) << axis;
        EXPECT_NEAR(animation_bounds.lo[axis], all.lo[axis], 0.02 * corner) << axis;
        EXPECT_NEAR(animation_bounds.hi[axis], all.hi[axis], 0.02 * corner) << axis;
    }
    EXPECT_TRUE(session.scene.objects[0].animation_bounds.empty()) << "the floor stands still";
}

TEST(AnimatedBounds, AreCachedPerAnimationAndDroppedWithTheSetting) {
    Scene scene = swinging_box(Interpolation::Linear);
    SceneSettings at_time{.fit_animation = true};
    pose_scene(scene, at_time);
    ASSERT_FALSE(scene.objects[1].animation_bounds.empty());
    scene.objects[1].animation_bounds.hi.x = 1000;  // a new search would repair it
    at_time.time = 0.3;
    pose_scene(scene, at_time);
    EXPECT_EQ(scene.objects[1].animation_bounds.hi.x, 1000) << "not once a frame";
    hide_objects(scene, {scene.nodes[std::size_t(scene.objects[0].node)].path});
    pose_scene(scene, at_time);
    hide_objects(scene, {});
    EXPECT_EQ(scene.objects[1].animation_bounds.hi.x, 1000) << "nor for what is hidden";
    at_time.animation = 1;  // an animation without keys
    pose_scene(scene, at_time);
    EXPECT_TRUE(scene.objects[1].animation_bounds.empty());
    at_time.animation = 0;
    pose_scene(scene, at_time);
    EXPECT_LT(scene.objects[1].animation_bounds.hi.x, 10);
    at_time.fit_animation = false;
    pose_scene(scene, at_time);
    EXPECT_TRUE(scene.objects[1].animation_bounds.empty());
    EXPECT_TRUE(scene.animation_bounds.empty());
}

TEST(AnimatedBounds, FollowThePlacement) {
    const Scene scene = swinging_box(Interpolation::Linear);
    const std::vector<std::string> sets{"scene.fit_animation=on", "scene.scale=4", "scene.distance=1000"};
    const auto first = session_at(scene, 0, sets);
    const auto lights = fit_lights(first.scene, first.settings);
    for (int i = 0; i < kTimes; ++i) {
        const Session session = session_at(scene, time_of(scene, i), sets);
        EXPECT_EQ(numbers_of(fit_lights(session.scene, session.settings)), numbers_of(lights)) << i;
        EXPECT_EQ(count_outside(session.scene, lights[0]), 0u) << i;
    }
}

TEST(AnimatedBounds, KeepLightsOfAFile) {
    const Scene scene = growing_triangle().load();
    for (const char* over : {"off", "on"})
        for (int i = 0; i < kTimes; ++i) {
            const Session session =
                session_at(scene, time_of(scene, i), {std::string("scene.fit_animation=") + over, "scene.ground=off"});
            const auto lights = fit_lights(session.scene, session.settings);
            EXPECT_LT(glm::distance(lights[0].position, glm::dvec3(1, 6, 2)), 1e-6) << over << " " << i;
        }
}

TEST(AnimatedBounds, ChangeNothingInStaticScenes) {
    const auto fitted = [](std::vector<std::string> sets) {
        const Session session = open_session({.scene = "boxes", .sets = std::move(sets)});
        return std::pair(numbers_of(fit_lights(session.scene, session.settings)), session.notes);
    };
    EXPECT_EQ(fitted({}).first, fitted({"scene.fit_animation=on"}).first);
    const std::vector<std::string> notes = fitted({"scene.fit_animation=on"}).second;
    EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& n) { return n.find("has no animation") != n.npos; }));
    const Scene scene = swinging_box(Interpolation::Linear);
    const auto rest = [&](std::vector<std::string> sets) {
        sets.push_back("scene.animation=-1");
        const Session session = session_at(scene, 0.5, std::move(sets));
        return numbers_of(fit_lights(session.scene, session.settings));
    };
    EXPECT_EQ(rest({}), rest({"scene.fit_animation=on"}));
    Settings s;
    EXPECT_TRUE(idle_reason(s, *find_setting("scene.fit_animation")).empty());
    s.scene.animation = -1;
    EXPECT_NE(idle_reason(s, *find_setting("scene.fit_animation")).find("rest pose"), std::string_view::npos);
}

// A picture that moves with its subject cannot be compared with itself.
TEST(AnimatedBounds, KeepTheAutomaticCameraOfTheFirstTime) {
    Scene scene = swinging_box(Interpolation::Linear);
    scene.file_scenes = {""};
    std::vector<Camera> cameras;
    for (const double time : {0.0, 0.3, 0.4, 1.0}) {
        Settings s;
        s.scene.animation = 0;
        s.scene.time = time;
        pose_scene(scene, s.scene);
        cameras.push_back(make_camera(scene, s, 1.5));
        EXPECT_EQ(cameras.back().eye, cameras[0].eye) << time;
        EXPECT_EQ(cameras.back().axes, cameras[0].axes) << time;
    }
    Settings away;
    away.scene.animation = 0;
    away.scene.time = 1;
    away.scene.distance = 1000;
    away.scene.scale = 2;
    pose_scene(scene, away.scene);
    const Camera c = make_camera(scene, away, 1.5);
    EXPECT_NEAR(c.focus, 2 * cameras[0].focus, 1e-6) << "but goes with where the scene is placed";
    away.scene.distance = 0;
    away.scene.scale = 1;
    away.scene.ground = Ground::Off;
    pose_scene(scene, away.scene);
    EXPECT_NE(make_camera(scene, away, 1.5).eye, cameras[0].eye) << "without a ground all of what is there is shown";
}

}  // namespace
}  // namespace si
