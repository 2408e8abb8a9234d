// Tests of the shared ray hierarchy: one object, built once, freed without users.
#include "renderer/reference/ray_scenes.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "renderer/reference/reference_task.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

using Weak = std::weak_ptr<const ReferenceScene>;

std::shared_ptr<const ReferenceGeometry> scene_geometry(const Scene& scene, const Settings& settings = {}) {
    return std::make_shared<const ReferenceGeometry>(scene, settings);
}

TEST(RaySceneCache, TwoUsersShareOneSceneAndItIsFreed) {
    RaySceneCache scenes;
    const Scene boxes = load_scene("boxes");
    const auto geometry = scene_geometry(boxes);
    EXPECT_EQ(scenes.find(geometry->key), nullptr);
    auto first = scenes.get(geometry);
    auto second = scenes.get(scene_geometry(boxes));  // another copy of the same triangles
    EXPECT_EQ(first, second);
    EXPECT_EQ(scenes.find(geometry->key), first);
    EXPECT_EQ(scenes.geometry(boxes, {}), geometry) << "and no copy more";
    EXPECT_EQ(scenes.size(), 1u);
    const Weak weak = first;
    first.reset();
    second.reset();
    EXPECT_FALSE(weak.expired()) << "the last one is kept for who comes next";
    scenes.clear();
    EXPECT_TRUE(weak.expired());
    EXPECT_EQ(scenes.size(), 0u);
}

TEST(RaySceneCache, KeepsAtMostOneUnusedScene) {
    RaySceneCache scenes;
    std::vector<Weak> weak;
    std::vector<Scene> all;
    for (int i = 0; i < 5; ++i) all.push_back(load_scene("boxes"));  // each with its own id
    const auto held = scenes.get(scene_geometry(all[0]));
    for (const Scene& scene : all) weak.push_back(scenes.get(scene_geometry(scene)));
    EXPECT_EQ(scenes.size(), 2u);
    EXPECT_EQ(weak[0].lock(), held);
    for (std::size_t i : {1u, 2u, 3u}) EXPECT_TRUE(weak[i].expired()) << i;
    EXPECT_FALSE(weak[4].expired());
    EXPECT_EQ(scenes.get(scene_geometry(all[0])), held);
    EXPECT_TRUE(weak[4].expired()) << "now another one is the last";
}

TEST(RaySceneCache, KeyDependsOnCasters) {
    RaySceneCache scenes;
    const Scene boxes = load_scene("boxes");
    Settings without;
    without.objects[boxes.nodes[std::size_t(boxes.objects[0].node)].path].cast = false;
    const auto all = scenes.get(scene_geometry(boxes)), fewer = scenes.get(scene_geometry(boxes, without));
    EXPECT_NE(all, fewer);
    EXPECT_GT(all->triangle_count(), fewer->triangle_count());
}

TEST(RaySceneCache, ConcurrentRequestsWaitForOneBuild) {
    RaySceneCache scenes;
    const Scene boxes = load_scene("boxes");
    const auto geometry = scene_geometry(boxes);
    std::promise<void> building, go_on;
    std::atomic<int> built{0};
    std::shared_ptr<const ReferenceScene> first, others[3];
    std::thread builder([&] {
        first = scenes.get(geometry, {.progress = [&](double) {  // called while it builds
                               ++built;
                               building.set_value();
                               go_on.get_future().wait();
                           }});
    });
    building.get_future().wait();
    // A waiting request can be stopped.
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(scenes.get(geometry, {.stop = stop.get_token()}), Cancelled);
    std::vector<std::thread> waiting;
    for (auto& other : others)
        waiting.emplace_back([&] { other = scenes.get(geometry, {.progress = [&](double) { ++built; }}); });
    // Other scenes do not wait.
    const Scene more = load_scene("boxes");
    EXPECT_NE(scenes.get(scene_geometry(more)), nullptr);
    go_on.set_value();
    builder.join();
    for (std::thread& t : waiting) t.join();
    EXPECT_EQ(built, 1);
    for (const auto& other : others) EXPECT_EQ(other, first);
}

TEST(RaySceneCache, CancelledBuildIsNotShared) {
    RaySceneCache scenes;
    const auto geometry = scene_geometry(load_scene("boxes"));
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(scenes.get(geometry, {.stop = stop.get_token()}), Cancelled);
    EXPECT_EQ(scenes.size(), 0u);
    EXPECT_NE(scenes.get(geometry), nullptr);
}

}  // namespace
}  // namespace si
