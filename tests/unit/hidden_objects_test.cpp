// Tests of hide_objects(): hidden objects keep their place, their share of the bounds and their pose.
#include <gtest/gtest.h>

#include "app/session/session.h"
#include "renderer/scene/ground.h"
#include "renderer/scenes/builtin.h"
#include "tests/support/box_scene.h"

namespace si {
namespace {

std::vector<std::string> paths(const Scene& scene) {
    std::vector<std::string> out;
    for (const Object* o : all_objects(scene)) out.push_back(scene.nodes[std::size_t(o->node)].path);
    return out;
}

TEST(HiddenObjects, KeepTheirTransformAndBoundsAndReturn) {
    Scene scene = load_scene("stage");
    const Scene before = scene;
    hide_objects(scene, {"Stage/Wall", "Stage/Ground"});
    EXPECT_EQ(scene.objects.size() + 2, before.objects.size());
    EXPECT_NE(scene.id, before.id);
    EXPECT_EQ(paths(scene), paths(before));
    refresh(scene);
    EXPECT_EQ(scene.bounds.lo, before.bounds.lo);
    EXPECT_EQ(scene.bounds.hi, before.bounds.hi);
    const std::uint64_t id = scene.id;
    hide_objects(scene, {"Stage/Wall", "Stage/Ground"});
    EXPECT_EQ(scene.id, id) << "nothing changed";
    hide_objects(scene, {"Stage/Wall"});
    EXPECT_EQ(scene.hidden.size(), 1u);
    hide_objects(scene, {"no such node"});
    EXPECT_TRUE(scene.hidden.empty());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        EXPECT_EQ(scene.objects[i].mesh, before.objects[i].mesh);
        EXPECT_EQ(scene.objects[i].world, before.objects[i].world);
    }
}

TEST(HiddenObjects, MoveWithTheSceneAndStayHidden) {
    Scene scene = load_scene("stage"), whole = scene;
    hide_objects(scene, {"Stage/Wall"});
    const SceneSettings far{.distance = 1000};
    pose_scene(scene, far);
    pose_scene(whole, far);
    ASSERT_EQ(scene.hidden.size(), 1u);
    EXPECT_EQ(scene.bounds.lo, whole.bounds.lo);
    EXPECT_EQ(scene.hidden[0].object.world, whole.objects[scene.hidden[0].place].world);
}

TEST(HiddenObjects, IncludeTheGroundUnderAModel) {
    Scene scene = test::box_scene({{}});
    scene.file_scenes = {""};  // as if from a file
    pose_scene(scene, {});
    ASSERT_FALSE(scene.ground_bounds.empty());
    const std::string ground = scene.nodes[std::size_t(scene.objects.back().node)].path;
    const std::size_t all = scene.objects.size();
    hide_objects(scene, {ground});
    pose_scene(scene, {});
    EXPECT_EQ(scene.objects.size(), all - 1);
    EXPECT_EQ(scene.hidden.size(), 1u);
    pose_scene(scene, {.ground = Ground::Off});
    EXPECT_EQ(scene.objects.size(), all - 1);
    EXPECT_TRUE(scene.hidden.empty()) << "there is none";
    EXPECT_TRUE(scene.ground_bounds.empty());
}

TEST(HiddenObjects, FollowSettingsOfASession) {
    const Session session = open_session({.scene = "stage", .sets = {"object.Stage/Wall.shown=false"}});
    ASSERT_EQ(session.scene.hidden.size(), 1u);
    EXPECT_EQ(hidden_paths(session.settings), std::set<std::string>{"Stage/Wall"});
}

}  // namespace
}  // namespace si
