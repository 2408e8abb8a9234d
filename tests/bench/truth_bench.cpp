// The ray-traced truth against the quickest bare loop over prepared rays, in turn, on the same number of threads. Read
// the ratio; the milliseconds hold for this machine and minute only.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <memory>

#include "app/context/headless_context.h"
#include "renderer/frame/renderer.h"
#include "renderer/reference/embree.h"
#include "renderer/reference/truth_task.h"
#include "tests/bench/median.h"
#include "tests/support/agreed_scene.h"

namespace si {
namespace {

using Clock = std::chrono::steady_clock;

double ms_of(const std::function<void()>& work) {
    const auto start = Clock::now();
    work();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The view to be traced, and the same rays for a hierarchy without any of our care.
struct Bench {
    TruthTask task;
    std::unique_ptr<TruthScene> casters;
    Receivers receivers;
    embree::Device device{rtcNewDevice(nullptr)};
    embree::Scene scene{rtcNewScene(device.get())};
    std::vector<RTCRay> rays;

    explicit Bench(test::AgreedSize size) {
        const HeadlessContext context;
        Renderer renderer;
        const Scene loaded = test::agreed_scene(size);
        Settings settings;
        settings.lights[0].elevation = 45;
        task = truth_task(renderer, loaded, settings, {.width = 1280, .height = 720}, 0, {.nearest = false});
        casters = std::make_unique<TruthScene>(task.geometry);
        receivers = place_receivers(*task.geometry, task.camera, task.ids, {});
        const glm::dvec3 centre = loaded.bounds.centre();
        for (std::uint32_t o = 0; o < task.geometry->objects.size(); ++o) add(o, centre);
        rtcCommitScene(scene.get());
        const glm::vec3 d(task.query.emitter.to_light);
        for (const Receiver& r : receivers.pixels) {
            if (!r.hit() || !(glm::dot(r.normal_ws, task.query.emitter.to_light) > 0)) continue;
            const glm::vec3 p(r.position_ws - centre + 1e-4 * loaded.bounds.radius() * r.normal_ws);
            rays.push_back({p.x, p.y, p.z, 0, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(), ~0u, 0, 0});
        }
    }

    void add(std::uint32_t object, const glm::dvec3& centre) {
        const TruthObject& o = task.geometry->objects[object];
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
    }

    /// Traces prepared rays `at_once` a call.
    double bare_ms(std::size_t at_once, RTCIntersectContextFlags flags, const Workers& workers) {
        std::vector<RTCRay> prepared = rays;
        return ms_of([&] {
            for_blocks((prepared.size() + at_once - 1) / at_once, workers, [&](std::size_t b) {
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                context.flags = flags;
                const std::size_t first = b * at_once;
                rtcOccluded1M(scene.get(), &context, &prepared[first],
                              unsigned(std::min(at_once, prepared.size() - first)), sizeof(RTCRay));
            });
        });
    }
};

void truth_against_bare(benchmark::State& state, test::AgreedSize size) {
    static std::map<test::AgreedSize, std::unique_ptr<Bench>> benches;
    auto& bench = benches[size];
    if (!bench) bench = std::make_unique<Bench>(size);
    const Workers workers{.threads = int(state.range(0))};
    struct Way {
        std::size_t at_once;
        RTCIntersectContextFlags flags;
        std::vector<double> ms;
    };
    std::vector<Way> ways;
    for (const std::size_t n : {256, 1024, 4096})
        for (const auto flags : {RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT, RTC_INTERSECT_CONTEXT_FLAG_COHERENT})
            ways.push_back({n, flags, {}});
    std::vector<double> ours, place;
    for (auto _ : state) {
        for (Way& w : ways) w.ms.push_back(bench->bare_ms(w.at_once, w.flags, workers));
        ours.push_back(ms_of([&] {
            benchmark::DoNotOptimize(trace_visibility(*bench->casters, bench->receivers, bench->task.query, workers));
        }));
        place.push_back(ms_of([&] {
            benchmark::DoNotOptimize(
                place_receivers(*bench->task.geometry, bench->task.camera, bench->task.ids, workers));
        }));
        state.SetIterationTime(ours.back() / 1000);
    }
    double fastest = std::numeric_limits<double>::infinity();
    for (const Way& w : ways) fastest = std::min(fastest, median(w.ms));
    state.counters["rays"] = double(bench->rays.size());
    state.counters["bare_ms"] = fastest;
    state.counters["ours_ms"] = median(ours);
    state.counters["place_ms"] = median(place);
    state.counters["rate_share"] = fastest / median(ours);
}

BENCHMARK_CAPTURE(truth_against_bare, 100k, test::AgreedSize::Triangles100k)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(9);
BENCHMARK_CAPTURE(truth_against_bare, 1m, test::AgreedSize::Triangles1M)
    ->Arg(1)
    ->Arg(2)
    ->UseManualTime()
    ->Iterations(9);

}  // namespace
}  // namespace si
