// Benchmarks of memory for a scene of a million triangles: growth of the process at each step, bytes a triangle.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <memory>

#include "app/context/headless_context.h"
#include "renderer/base/held_memory.h"
#include "renderer/reference/reference_task.h"
#include "renderer/render/reference_frames.h"
#include "renderer/render/renderer.h"
#include "tests/support/agreed_scene.h"

namespace si {
namespace {

/// Returns the memory of this process without freed blocks, bytes.
double resident_bytes() {
    malloc_trim(0);
    std::ifstream in("/proc/self/statm");
    double all = 0, resident = 0;
    in >> all >> resident;
    return resident * double(sysconf(_SC_PAGESIZE));
}

/// Returns the bytes that a holder reports.
double reported_bytes(std::string_view holder) {
    for (const MemoryUse& h : memory_report().holders)
        if (h.holder == holder) return double(h.bytes);
    return 0;
}

void memory_by_holder(benchmark::State& state) {
    for (auto _ : state) {
        const HeadlessContext context;
        Renderer renderer;
        FrameRequest request{.width = 640, .height = 360};
        // Programs and images are not counted as memory of the scene.
        const Scene small = test::agreed_scene(test::AgreedSize::Triangles100k);
        renderer.render(small, {}, request);
        { ReferenceCache().trace(reference_task(renderer, small, {}, request, 0, {.nearest = false})); }
        glFinish();
        auto grown = [before = resident_bytes()]() mutable {
            const double now = resident_bytes();
            return now - std::exchange(before, now);
        };
        const Scene scene = test::agreed_scene(test::AgreedSize::Triangles1M);
        const double triangles = double(scene.triangle_count());
        std::size_t meshes = 0;
        for (const Mesh& m : scene.meshes) meshes += m.indices.size() / 3;
        state.counters["scene"] = grown() / triangles;
        {
            const Scene copy = scene;  // as background searches do
            state.counters["scene_copy"] = grown() / triangles;
        }
        grown();
        renderer.render(scene, {}, request);
        glFinish();
        state.counters["driver"] = grown() / triangles;
        state.counters["told_vertices"] = reported_bytes("scene's vertices") / triangles;
        ReferenceCache cache;
        ReferenceTask task = reference_task(renderer, scene, {}, request, 0, {.nearest = false});
        state.counters["truth_copy"] = grown() / triangles;
        state.counters["told_scenes"] = reported_bytes("scenes") / triangles;
        const TracedReference traced = cache.trace(task);
        task = {};
        state.counters["hierarchy_and_truth"] = grown() / triangles;
        state.counters["told_hierarchies"] = reported_bytes("hierarchies of rays") / triangles;
        state.counters["told_receivers_and_truths"] =
            (reported_bytes("receivers") + reported_bytes("truths")) / triangles;
        // Another frame, light and reference of the same casters must share the caster data.
        Settings turned;
        turned.lights[0].azimuth += 30;
        renderer.render(scene, turned, request);
        cache.trace(reference_task(renderer, scene, turned, request, 0, {.nearest = false}));
        glFinish();
        state.counters["second_light"] = grown() / triangles;
        state.counters["triangles"] = triangles;
        state.counters["triangles_in_meshes"] = double(meshes);
    }
}

BENCHMARK(memory_by_holder)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace si
