// Benchmarks of the ray-traced reference, in turn with fast loops over rays on the same number of threads. Compare the
// ratios; milliseconds hold for one machine and run only. `rate_share` compares with the fastest loop, `robust_share`
// with the fastest watertight loop, which the reference demands. `prepared_share` compares with the fastest loop that
// makes rays from receivers, as the reference does. Names with `_cpu` use processor time.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <memory>

#include "app/context/headless_context.h"
#include "renderer/base/median.h"
#include "renderer/reference/embree.h"
#include "renderer/reference/reference_task.h"
#include "renderer/render/reference_frames.h"
#include "renderer/render/renderer.h"
#include "tests/bench/rounds.h"
#include "tests/support/agreed_scene.h"

namespace si {
namespace {

/// Times of both kinds: wall time, and processor time of all threads, which other processes disturb less.
struct TakenMs {
    double wall = 0, cpu = 0;
};

TakenMs ms_of(const std::function<void()>& work) {
    const double cpu = processor_ms();
    const double wall = wall_ms(work);
    return {wall, processor_ms() - cpu};
}

struct Taken {
    std::vector<double> wall, cpu;
    void push_back(TakenMs ms) {
        wall.push_back(ms.wall);
        cpu.push_back(ms.cpu);
    }
};

/// View to trace, and the same rays for a plain hierarchy.
struct Bench {
    ReferenceTask task;
    std::unique_ptr<ReferenceScene> casters;
    Receivers receivers;
    embree::Device device{rtcNewDevice(nullptr)};
    embree::Scene scene{rtcNewScene(device.get())}, robust{rtcNewScene(device.get())};
    std::vector<RTCRay> rays;
    std::vector<const Receiver*> facing;  ///< receivers that face the light
    glm::dvec3 centre{0};
    double ray_offset = 0;

    explicit Bench(test::AgreedSize size) {
        const HeadlessContext context;
        Renderer renderer;
        const Scene loaded = test::agreed_scene(size);
        Settings settings;
        settings.lights[0].elevation = 45;
        task = reference_task(renderer, loaded, settings, {.width = 1280, .height = 720}, 0, {.nearest = false});
        casters = std::make_unique<ReferenceScene>(task.geometry);
        receivers = reconstruct_receivers(*task.geometry, task.camera, task.ids, {});
        centre = loaded.bounds.centre();
        ray_offset = 1e-4 * loaded.bounds.radius();
        rtcSetSceneFlags(robust.get(), RTC_SCENE_FLAG_ROBUST);
        for (std::uint32_t o = 0; o < task.geometry->objects.size(); ++o) add(o);
        rtcCommitScene(scene.get());
        rtcCommitScene(robust.get());
        for (const Receiver& r : receivers.pixels) {
            if (!r.hit() || !(glm::dot(r.normal_ws, task.query.emitter.to_light) > 0)) continue;
            facing.push_back(&r);
            rays.push_back(ray_of(r));
        }
    }

    RTCRay ray_of(const Receiver& r) const {
        const glm::vec3 d(task.query.emitter.to_light), p(r.position_ws - centre + ray_offset * r.normal_ws);
        return {p.x, p.y, p.z, 0, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(), ~0u, 0, 0};
    }

    void add(std::uint32_t object) {
        const ReferenceObject& o = task.geometry->objects[object];
        const embree::Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
        auto* corners = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), o.mesh->positions.size()));
        for (std::size_t i = 0; i < o.mesh->positions.size(); ++i)
            corners[i] = glm::vec3(glm::dvec3(o.world * glm::dvec4(glm::dvec3(o.mesh->positions[i]), 1)) - centre);
        auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0,
                                                                            RTC_FORMAT_UINT3, 12, o.mesh->triangles()));
        std::copy(o.mesh->indices.begin(), o.mesh->indices.end(), indices);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometry(scene.get(), geometry.get());
        rtcAttachGeometry(robust.get(), geometry.get());
    }

    void occlude(const embree::Scene& through, RTCRay* first, std::size_t count, RTCIntersectContextFlags flags) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = flags;
        rtcOccluded1M(through.get(), &context, first, unsigned(count), sizeof(RTCRay));
    }

    /// Makes rays from receivers and traces them, `at_once` a call.
    TakenMs prepared_ms(std::size_t at_once, const Workers& workers) {
        return ms_of([&] {
            parallel_for_blocks((facing.size() + at_once - 1) / at_once, workers, [&](std::size_t b) {
                thread_local std::vector<RTCRay> some;
                some.clear();
                for (std::size_t i = b * at_once; i < std::min((b + 1) * at_once, facing.size()); ++i)
                    some.push_back(ray_of(*facing[i]));
                occlude(scene, some.data(), some.size(), RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
            });
        });
    }

    /// Traces prepared rays, `at_once` a call.
    TakenMs bare_ms(const embree::Scene& through, std::size_t at_once, RTCIntersectContextFlags flags,
                    const Workers& workers) {
        std::vector<RTCRay> prepared = rays;
        return ms_of([&] {
            parallel_for_blocks((prepared.size() + at_once - 1) / at_once, workers, [&](std::size_t b) {
                const std::size_t first = b * at_once;
                occlude(through, &prepared[first], std::min(at_once, prepared.size() - first), flags);
            });
        });
    }
};

void reference_against_bare(benchmark::State& state, test::AgreedSize size) {
    static std::map<test::AgreedSize, std::unique_ptr<Bench>> benches;
    auto& bench = benches[size];
    if (!bench) bench = std::make_unique<Bench>(size);
    const Workers workers{.threads = int(state.range(0))};
    struct Tracing {
        std::size_t at_once;
        RTCIntersectContextFlags flags;
        Taken ms, robust_ms;
    };
    std::vector<Tracing> ways;
    for (const std::size_t n : {256, 1024, 4096})
        for (const auto flags : {RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT, RTC_INTERSECT_CONTEXT_FLAG_COHERENT})
            ways.push_back({n, flags, {}, {}});
    std::map<std::size_t, Taken> prepared = {{256, {}}, {1024, {}}, {4096, {}}};
    Taken ours, place;
    for (auto _ : state) {
        for (Tracing& w : ways) {
            w.ms.push_back(bench->bare_ms(bench->scene, w.at_once, w.flags, workers));
            w.robust_ms.push_back(bench->bare_ms(bench->robust, w.at_once, w.flags, workers));
        }
        for (auto& [at_once, ms] : prepared) ms.push_back(bench->prepared_ms(at_once, workers));
        ours.push_back(ms_of([&] {
            benchmark::DoNotOptimize(trace_visibility(*bench->casters, bench->receivers, bench->task.query, workers));
        }));
        place.push_back(ms_of([&] {
            benchmark::DoNotOptimize(
                reconstruct_receivers(*bench->task.geometry, bench->task.camera, bench->task.ids, workers));
        }));
        state.SetIterationTime(ours.wall.back() / 1000);
    }
    for (const bool cpu : {false, true}) {
        const auto of = [cpu](const Taken& t) -> const std::vector<double>& { return cpu ? t.cpu : t.wall; };
        std::vector<const Taken*> bare, robust, made;
        for (const Tracing& w : ways) {
            bare.push_back(&w.ms);
            robust.push_back(&w.robust_ms);
        }
        for (const auto& [at_once, ms] : prepared) made.push_back(&ms);
        const auto quickest = [&](std::vector<const Taken*> all) {
            return *std::ranges::min_element(all, {}, [&](const Taken* t) { return median(of(*t)); });
        };
        const auto report = [&](const std::string& name, const Taken& t) {
            state.counters[name + (cpu ? "_cpu_ms" : "_ms")] = median(of(t));
        };
        // Rounds alternate, so that drift of the machine affects both.
        const auto share = [&](const std::string& name, const Taken& t) {
            std::vector<double> shares;
            for (std::size_t i = 0; i < of(t).size(); ++i) shares.push_back(of(t)[i] / of(ours)[i]);
            const Quartiles q(std::move(shares));
            const std::string label = name + (cpu ? "_share_cpu" : "_share");
            state.counters[label] = q.median;
            state.counters[label + "_p25"] = q.p25;
            state.counters[label + "_p75"] = q.p75;
        };
        report("ours", ours);
        report("place", place);
        for (const auto& [name, all] : {std::pair("rate", bare), {"robust", robust}, {"prepared", made}}) {
            report(name, *quickest(all));
            share(name, *quickest(all));
        }
    }
    state.counters["rays"] = double(bench->rays.size());
}

BENCHMARK_CAPTURE(reference_against_bare, 100k, test::AgreedSize::Triangles100k)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(bench_rounds(9));
BENCHMARK_CAPTURE(reference_against_bare, 1m, test::AgreedSize::Triangles1M)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(bench_rounds(9));

}  // namespace
}  // namespace si
