// Who holds how much of a scene of a million triangles: bytes a triangle that the process grew by at each step.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <memory>

#include "app/context/headless_context.h"
#include "renderer/base/held.h"
#include "renderer/frame/renderer.h"
#include "renderer/reference/truth_task.h"
#include "tests/support/agreed_scene.h"

namespace si {
namespace {

/// Of this process, without what was freed.
double resident_bytes() {
    malloc_trim(0);
    std::ifstream in("/proc/self/statm");
    double all = 0, resident = 0;
    in >> all >> resident;
    return resident * double(sysconf(_SC_PAGESIZE));
}

/// Bytes by the holder's own account.
double told(std::string_view holder) {
    for (const HeldBytes& h : memory_facts().holders)
        if (h.holder == holder) return double(h.bytes);
    return 0;
}

void memory_by_holder(benchmark::State& state) {
    for (auto _ : state) {
        const HeadlessContext context;
        Renderer renderer;
        FrameRequest request{.width = 640, .height = 360};
        // What programs and images take is no part of a scene.
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
            const Scene copy = scene;  // as each search in the background takes
            state.counters["scene_copy"] = grown() / triangles;
        }
        grown();
        renderer.render(scene, {}, request);
        glFinish();
        state.counters["driver"] = grown() / triangles;
        state.counters["told_vertices"] = told("scene's vertices") / triangles;
        ReferenceCache cache;
        ReferenceTask task = reference_task(renderer, scene, {}, request, 0, {.nearest = false});
        state.counters["truth_copy"] = grown() / triangles;
        state.counters["told_scenes"] = told("scenes") / triangles;
        const TracedReference traced = cache.trace(task);
        task = {};
        state.counters["hierarchy_and_truth"] = grown() / triangles;
        state.counters["told_hierarchies"] = told("hierarchies of rays") / triangles;
        state.counters["told_receivers_and_truths"] = (told("receivers") + told("truths")) / triangles;
        // Another frame, light and truth of the same casters must not hold them again.
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
