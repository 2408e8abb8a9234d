// Benchmarks of loading, compared with reading the bytes and copying them once, and of frames of scenes with many
// objects.
#include "tests/bench/load_bench.h"

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>

#include "app/context/headless_context.h"
#include "app/session/session.h"
#include "renderer/gltf/gltf.h"
#include "renderer/render/renderer.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "tests/support/mesh_scene.h"

namespace si {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Reads a file into one buffer and copies the buffer: a lower bound for loaders. Returns milliseconds, -1 on failure.
double read_and_copy_ms(const std::filesystem::path& path) {
    const auto start = Clock::now();
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return -1;
    const std::size_t size = std::filesystem::file_size(path);
    const auto bytes = std::make_unique_for_overwrite<char[]>(size),
               copy = std::make_unique_for_overwrite<char[]>(size);
    std::size_t got = 0;
    for (ssize_t n = 1; got < size && n > 0; got += std::size_t(n > 0 ? n : 0))
        n = read(file, bytes.get() + got, size - got);
    close(file);
    std::memcpy(copy.get(), bytes.get(), size);
    benchmark::DoNotOptimize(copy.get());
    return got == size ? ms_since(start) : -1;
}

std::filesystem::path shared_file(const char* name) {
    return std::filesystem::path(SI_SOURCE_DIR) / "../shared" / name;
}

/// Times loading and read_and_copy_ms() of a file in turns, each in fresh memory, as at program start. Otherwise malloc
/// would reuse freed memory.
void load(benchmark::State& state, const std::filesystem::path& path) {
    mallopt(M_MMAP_THRESHOLD, 128 << 10);
    double bare = 0, ours = 0;
    for (auto _ : state) {
        bare += read_and_copy_ms(path);
        const auto start = Clock::now();
        const Scene scene = load_scene(path.string());
        const double ms = ms_since(start);
        benchmark::DoNotOptimize(scene.meshes.data());
        ours += ms;
        state.SetIterationTime(ms / 1000);
    }
    state.counters["bare_ms"] = bare / double(state.iterations());
    state.counters["ratio"] = ours / bare;
}

/// Makes a million triangles in 61 meshes, most of them instanced.
void load_shared_million(benchmark::State& state) {
    const auto path = shared_file("perf/scene1m.glb");
    if (!std::filesystem::exists(path)) return state.SkipWithError("../shared/perf/scene1m.glb is missing");
    load(state, path);
}

/// Makes a million triangles of one indexed mesh: 24 MB with normals. Without normals, 18 MB become 84 since triangles
/// share no vertices.
void load_plain_million(benchmark::State& state, bool normals) {
    const auto path = std::filesystem::path(SI_TEST_OUTPUT_DIR) / (normals ? "plain_1m.glb" : "flat_1m.glb");
    Mesh mesh = make_plane(20, 20, 708, 708);
    mesh.uv.clear();
    Scene scene = make_scene(std::move(mesh));
    if (!normals) scene.meshes[0].normals.clear();
    save_gltf(scene, path);
    load(state, path);
    std::filesystem::remove(path);
}

/// Makes 50,000 boxes of one mesh on nodes of their own, in a square.
Scene make_instances() {
    Scene scene;
    scene.name = "50,000 instances";
    const int mesh = add_mesh(scene, "Box", make_box(glm::dvec3(0.5)), add_material(scene, "grey", {0.6f, 0.6f, 0.6f}));
    const int node = add_node(scene, "Field");
    for (int i = 0; i < 50000; ++i) {
        Object o;
        o.node = node;
        o.mesh = mesh;
        o.instance = moved(i % 224, 0, i / 224);
        scene.objects.push_back(o);
    }
    finalise(scene);
    return scene;
}

/// Times waits in a scene of many objects, each as one frame of 1280 x 720. Cases: first frame (upload, arrangement,
/// programs), no change, another bias, a turned light, a moved node, changed culling of one object, everything drawn
/// again.
void many_objects(benchmark::State& state, Scene (*make)()) {
    std::map<std::string, double> sum;
    for (auto _ : state) {
        HeadlessContext context;
        Renderer renderer;
        auto start = Clock::now();
        Scene scene = make();
        sum["make_ms"] += ms_since(start);
        Settings s = base_settings(scene);
        FrameRequest request{.width = 1280, .height = 720};
        const auto frame_ms = [&](auto&& change) {
            glFinish();
            start = Clock::now();
            change();
            renderer.render(scene, s, request);
            glFinish();
            return ms_since(start);
        };
        const auto nothing = [] {};
        sum["first_ms"] += frame_ms(nothing);
        sum["unchanged_ms"] += frame_ms(nothing);
        set_setting(s, "bias.kind", "slope");
        frame_ms([&] { s.bias.slope += 1; });  // compiles
        sum["bias_ms"] += frame_ms([&] { s.bias.slope += 1; });
        sum["light_turned_ms"] += frame_ms([&] { s.lights[0].azimuth += 1; });
        sum["node_moved_ms"] += frame_ms([&] {
            scene.nodes.back().local[3].y += 0.1;
            refresh(scene);
        });
        sum["object_culled_ms"] += frame_ms([&] { s.objects[scene.nodes.back().path].cull = ObjectCull::Back; });
        request.force = true;
        state.SetIterationTime(frame_ms(nothing) / 1000);
    }
    for (const auto& [name, ms] : sum) state.counters[name] = ms / double(state.iterations());
}

Scene make_forest() {
    return load_scene(shared_file("models/gen_forest_10k/forest_10k.glb").string());
}

}  // namespace

void register_load_benchmarks(int rounds) {
    const auto add = [&](const char* name, auto function) {
        benchmark::RegisterBenchmark(name, function)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(rounds);
    };
    add("load/1M_shared", load_shared_million);
    add("load/1M_plain", [](benchmark::State& s) { load_plain_million(s, true); });
    add("load/1M_without_normals", [](benchmark::State& s) { load_plain_million(s, false); });
    if (std::filesystem::exists(shared_file("models/gen_forest_10k/forest_10k.glb")))
        add("next_frame/10k_nodes", [](benchmark::State& s) { many_objects(s, make_forest); });
    add("next_frame/50k_instances", [](benchmark::State& s) { many_objects(s, make_instances); });
}

}  // namespace si
