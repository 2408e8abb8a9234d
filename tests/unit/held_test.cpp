// Who holds memory: what is told of holders, and what they let go.
#include "renderer/base/held.h"

#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

#include "renderer/reference/ray_scenes.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

HeldBytes of(const std::string& holder) {
    for (const HeldBytes& h : memory_facts().holders)
        if (h.holder == holder) return h;
    return {};
}

TEST(HeldMemory, IsToldUntilItIsLetGo) {
    std::optional<HeldMemory> first(std::in_place, "tests' bytes", 1000);
    {
        HeldMemory copy = *first, moved = std::move(copy);
        EXPECT_EQ(of("tests' bytes").bytes, 2000u);
        EXPECT_EQ(of("tests' bytes").count, 2u);
        EXPECT_EQ(copy.bytes(), 0u);
        moved.add(500);
        moved.add(-200);
        EXPECT_EQ(of("tests' bytes").bytes, 2300u);
        moved = *first;
        EXPECT_EQ(of("tests' bytes").bytes, 2000u);
    }
    EXPECT_EQ(of("tests' bytes").bytes, 1000u);
    EXPECT_EQ(of("tests' bytes").count, 1u);
    EXPECT_EQ(of("tests' bytes").most, 3300u) << "while there were three";
    first.reset();
    EXPECT_EQ(of("tests' bytes").bytes, 0u);
    HeldMemory nobody;
    nobody.add(7);
    EXPECT_EQ(nobody.bytes(), 0u);
}

#if !defined(__SANITIZE_ADDRESS__)  // which keeps what was freed
TEST(ProcessMemory, WhatWasFreedGoesBackToTheSystem) {
    // Below what malloc() maps by itself, with holes that end no page from above.
    constexpr std::size_t kBlock = 64 << 10, kBlocks = 1600;
    std::vector<std::vector<char>> blocks, kept;
    for (std::size_t i = 0; i < kBlocks; ++i) {
        blocks.emplace_back(kBlock, char(i));
        if (i % 100 == 0) kept.emplace_back(kBlock, char(i));
    }
    const std::uint64_t full = process_memory().resident;
    blocks.clear();
    give_back_free_pages();
    EXPECT_LT(process_memory().resident + kBlock * kBlocks * 3 / 4, full);
}
#endif

TEST(HeldMemory, ThreadsAddUp) {
    HeldMemory held("threads' bytes", 0);
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < 4; ++t)
            threads.emplace_back([&] {
                for (int i = 0; i < 1000; ++i) {
                    held.add(3);
                    held.add(-1);
                }
            });
    }
    EXPECT_EQ(of("threads' bytes").bytes, 8000u);
}

TEST(HeldMemory, ScenesAndHierarchiesTellWhatTheyTake) {
    ray_scenes().forget();  // what tests before have left
    const std::uint64_t scenes = of("scenes").bytes;
    {
        const Scene scene = load_scene("teapot");
        std::uint64_t least = 0;
        for (const Mesh& m : scene.meshes) least += array_bytes(m.positions) + array_bytes(m.indices);
        EXPECT_GT(of("scenes").bytes, scenes + least);
        EXPECT_LT(of("scenes").bytes, scenes + 10 * least);
        const std::uint64_t one = of("scenes").bytes;
        Scene copy = scene;
        EXPECT_LT(of("scenes").bytes, one + least / 4) << "what copies have in common is held twice";
        copy.meshes[0].positions.edit()[0].x += 0.25f;
        refresh(copy);
        EXPECT_FALSE(copy.meshes[0].positions.shares(scene.meshes[0].positions));
        EXPECT_TRUE(copy.meshes[0].indices.shares(scene.meshes[0].indices));
        const std::uint64_t before = of("scenes").bytes;
        const auto geometry = std::make_shared<const ReferenceGeometry>(scene, Settings());
        EXPECT_EQ(of("scenes").bytes, before);
        for (std::size_t i = 0; i < scene.objects.size(); ++i) {
            const Mesh& mesh = scene.meshes[std::size_t(scene.objects[i].mesh)];
            EXPECT_TRUE(geometry->objects[i].mesh->positions.shares(mesh.positions)) << i;
            EXPECT_TRUE(geometry->objects[i].mesh->indices.shares(mesh.indices)) << i;
        }
        const auto rays = ray_scenes().get(geometry);
        EXPECT_GE(of("hierarchies of rays").bytes, least) << "Embree's own account";
    }
    EXPECT_GT(of("scenes").bytes, scenes) << "the hierarchy that is kept needs its triangles";
    ray_scenes().forget();
    EXPECT_EQ(of("hierarchies of rays").bytes, 0u);
    EXPECT_EQ(of("scenes").bytes, scenes);
}

TEST(HeldMemory, TheProcessHasMoreThanItsHolders) {
    const std::uint64_t before = process_memory().resident;
    ASSERT_GT(before, 1u << 20);
    std::vector<char> block(64 << 20, 'x');
    const ProcessMemory with = process_memory();
    EXPECT_GT(with.resident, before + (48u << 20)) << block[5];
    EXPECT_GE(with.peak, with.resident);
#ifndef __SANITIZE_ADDRESS__  // which has a heap of its own
    EXPECT_GT(with.heap, 64u << 20);
#endif
}

TEST(HeldMemory, IsSaidInUnitsThatSuitIt) {
    EXPECT_EQ(bytes_text(12), "12 bytes");
    EXPECT_EQ(bytes_text(300 << 10), "300 KiB");
    EXPECT_EQ(bytes_text(3u << 19), "1.5 MiB");
    EXPECT_EQ(bytes_text(300u << 20), "300 MiB");
}

}  // namespace
}  // namespace si
