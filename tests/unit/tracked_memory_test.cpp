// Tests of tracked memory: reports of holders, and released memory.
#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

#include "renderer/base/held_memory.h"
#include "renderer/reference/ray_scenes.h"
#include "renderer/scenes/builtin.h"

namespace si {
namespace {

MemoryUse memory_of(const std::string& holder) {
    for (const MemoryUse& h : memory_report().holders)
        if (h.holder == holder) return h;
    return {};
}

TEST(TrackedMemory, IsReportedUntilReleased) {
    std::optional<TrackedMemory> first(std::in_place, "tests' bytes", 1000);
    {
        TrackedMemory copy = *first, moved = std::move(copy);
        EXPECT_EQ(memory_of("tests' bytes").bytes, 2000u);
        EXPECT_EQ(memory_of("tests' bytes").count, 2u);
        EXPECT_EQ(copy.bytes(), 0u);
        moved.add(500);
        moved.add(-200);
        EXPECT_EQ(memory_of("tests' bytes").bytes, 2300u);
        moved = *first;
        EXPECT_EQ(memory_of("tests' bytes").bytes, 2000u);
    }
    EXPECT_EQ(memory_of("tests' bytes").bytes, 1000u);
    EXPECT_EQ(memory_of("tests' bytes").count, 1u);
    EXPECT_EQ(memory_of("tests' bytes").most, 3300u) << "while there were three";
    first.reset();
    EXPECT_EQ(memory_of("tests' bytes").bytes, 0u);
    TrackedMemory nobody;
    nobody.add(7);
    EXPECT_EQ(nobody.bytes(), 0u);
}

#if !defined(__SANITIZE_ADDRESS__)  // which keeps freed memory
TEST(ProcessMemory, FreedMemoryReturnsToTheSystem) {
    // Sizes below malloc()'s mmap threshold, with holes that end no page from above.
    constexpr std::size_t kBlock = 64 << 10, kBlocks = 1600;
    std::vector<std::vector<char>> blocks, kept;
    for (std::size_t i = 0; i < kBlocks; ++i) {
        blocks.emplace_back(kBlock, char(i));
        if (i % 100 == 0) kept.emplace_back(kBlock, char(i));
    }
    const std::uint64_t full = process_memory().resident;
    blocks.clear();
    trim_heap();
    EXPECT_LT(process_memory().resident + kBlock * kBlocks * 3 / 4, full);
}
#endif

TEST(TrackedMemory, ThreadsAddUp) {
    TrackedMemory held("threads' bytes", 0);
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
    EXPECT_EQ(memory_of("threads' bytes").bytes, 8000u);
}

TEST(TrackedMemory, ScenesAndHierarchiesReportTheirSize) {
    ray_scenes().clear();  // left by earlier tests
    const std::uint64_t scenes = memory_of("scenes").bytes;
    {
        const Scene scene = load_scene("teapot");
        std::uint64_t least = 0;
        for (const Mesh& m : scene.meshes) least += array_bytes(m.positions) + array_bytes(m.indices);
        EXPECT_GT(memory_of("scenes").bytes, scenes + least);
        EXPECT_LT(memory_of("scenes").bytes, scenes + 10 * least);
        const std::uint64_t one = memory_of("scenes").bytes;
        Scene copy = scene;
        EXPECT_LT(memory_of("scenes").bytes, one + least / 4) << "what copies have in common is held twice";
        copy.meshes[0].positions.edit()[0].x += 0.25f;
        refresh(copy);
        EXPECT_FALSE(copy.meshes[0].positions.shares_storage_with(scene.meshes[0].positions));
        EXPECT_TRUE(copy.meshes[0].indices.shares_storage_with(scene.meshes[0].indices));
        const std::uint64_t before = memory_of("scenes").bytes;
        const auto geometry = std::make_shared<const ReferenceGeometry>(scene, Settings());
        EXPECT_EQ(memory_of("scenes").bytes, before);
        for (std::size_t i = 0; i < scene.objects.size(); ++i) {
            const Mesh& mesh = scene.meshes[std::size_t(scene.objects[i].mesh)];
            EXPECT_TRUE(geometry->objects[i].mesh->positions.shares_storage_with(mesh.positions)) << i;
            EXPECT_TRUE(geometry->objects[i].mesh->indices.shares_storage_with(mesh.indices)) << i;
        }
        const auto rays = ray_scenes().get(geometry);
        EXPECT_GE(memory_of("hierarchies of rays").bytes, least) << "Embree's own account";
    }
    EXPECT_GT(memory_of("scenes").bytes, scenes) << "the hierarchy that is kept needs its triangles";
    ray_scenes().clear();
    EXPECT_EQ(memory_of("hierarchies of rays").bytes, 0u);
    EXPECT_EQ(memory_of("scenes").bytes, scenes);
}

TEST(TrackedMemory, ProcessUsesMoreThanItsHolders) {
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

TEST(TrackedMemory, IsPrintedInSuitableUnits) {
    EXPECT_EQ(bytes_text(12), "12 bytes");
    EXPECT_EQ(bytes_text(300 << 10), "300 KiB");
    EXPECT_EQ(bytes_text(3u << 19), "1.5 MiB");
    EXPECT_EQ(bytes_text(300u << 20), "300 MiB");
}

}  // namespace
}  // namespace si
