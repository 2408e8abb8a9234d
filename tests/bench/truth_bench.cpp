// The ray-traced truth against the quickest bare loop over prepared rays, in turn, on the same number of threads. Read
// the ratios; the milliseconds hold for this machine and minute only. `rate_share` is that of the quickest loop there
// is, `robust_share` that of the quickest that no ray slips through between triangles, as the truth demands;
// `prepared_share` that of the quickest whose rays are made from receivers as it goes, as the truth's are.
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
    embree::Scene scene{rtcNewScene(device.get())}, robust{rtcNewScene(device.get())};
    std::vector<RTCRay> rays;
    std::vector<const Receiver*> facing;  ///< what the rays start from
    glm::dvec3 centre{0};
    double lift = 0;

    explicit Bench(test::AgreedSize size) {
        const HeadlessContext context;
        Renderer renderer;
        const Scene loaded = test::agreed_scene(size);
        Settings settings;
        settings.lights[0].elevation = 45;
        task = truth_task(renderer, loaded, settings, {.width = 1280, .height = 720}, 0, {.nearest = false});
        casters = std::make_unique<TruthScene>(task.geometry);
        receivers = place_receivers(*task.geometry, task.camera, task.ids, {});
        centre = loaded.bounds.centre();
        lift = 1e-4 * loaded.bounds.radius();
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
        const glm::vec3 d(task.query.emitter.to_light), p(r.position_ws - centre + lift * r.normal_ws);
        return {p.x, p.y, p.z, 0, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(), ~0u, 0, 0};
    }

    void add(std::uint32_t object) {
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
        rtcAttachGeometry(robust.get(), geometry.get());
    }

    void occlude(const embree::Scene& through, RTCRay* first, std::size_t count, RTCIntersectContextFlags flags) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = flags;
        rtcOccluded1M(through.get(), &context, first, unsigned(count), sizeof(RTCRay));
    }

    /// Makes rays of receivers and traces them, `at_once` a call.
    double prepared_ms(std::size_t at_once, const Workers& workers) {
        return ms_of([&] {
            for_blocks((facing.size() + at_once - 1) / at_once, workers, [&](std::size_t b) {
                thread_local std::vector<RTCRay> some;
                some.clear();
                for (std::size_t i = b * at_once; i < std::min((b + 1) * at_once, facing.size()); ++i)
                    some.push_back(ray_of(*facing[i]));
                occlude(scene, some.data(), some.size(), RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
            });
        });
    }

    /// Traces prepared rays `at_once` a call.
    double bare_ms(const embree::Scene& through, std::size_t at_once, RTCIntersectContextFlags flags,
                   const Workers& workers) {
        std::vector<RTCRay> prepared = rays;
        return ms_of([&] {
            for_blocks((prepared.size() + at_once - 1) / at_once, workers, [&](std::size_t b) {
                const std::size_t first = b * at_once;
                occlude(through, &prepared[first], std::min(at_once, prepared.size() - first), flags);
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
        std::vector<double> ms, robust_ms;
    };
    std::vector<Way> ways;
    for (const std::size_t n : {256, 1024, 4096})
        for (const auto flags : {RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT, RTC_INTERSECT_CONTEXT_FLAG_COHERENT})
            ways.push_back({n, flags, {}, {}});
    std::map<std::size_t, std::vector<double>> prepared = {{256, {}}, {1024, {}}, {4096, {}}};
    std::vector<double> ours, place;
    for (auto _ : state) {
        for (Way& w : ways) {
            w.ms.push_back(bench->bare_ms(bench->scene, w.at_once, w.flags, workers));
            w.robust_ms.push_back(bench->bare_ms(bench->robust, w.at_once, w.flags, workers));
        }
        for (auto& [at_once, ms] : prepared) ms.push_back(bench->prepared_ms(at_once, workers));
        ours.push_back(ms_of([&] {
            benchmark::DoNotOptimize(trace_visibility(*bench->casters, bench->receivers, bench->task.query, workers));
        }));
        place.push_back(ms_of([&] {
            benchmark::DoNotOptimize(
                place_receivers(*bench->task.geometry, bench->task.camera, bench->task.ids, workers));
        }));
        state.SetIterationTime(ours.back() / 1000);
    }
    double fastest = std::numeric_limits<double>::infinity(), fastest_robust = fastest;
    for (const Way& w : ways) {
        fastest = std::min(fastest, median(w.ms));
        fastest_robust = std::min(fastest_robust, median(w.robust_ms));
    }
    double prepared_ms = std::numeric_limits<double>::infinity();
    for (const auto& [at_once, ms] : prepared) prepared_ms = std::min(prepared_ms, median(ms));
    state.counters["prepared_ms"] = prepared_ms;
    state.counters["rays"] = double(bench->rays.size());
    state.counters["bare_ms"] = fastest;
    state.counters["ours_ms"] = median(ours);
    state.counters["place_ms"] = median(place);
    state.counters["robust_ms"] = fastest_robust;
    state.counters["rate_share"] = fastest / median(ours);
    state.counters["robust_share"] = fastest_robust / median(ours);
    state.counters["prepared_share"] = prepared_ms / median(ours);
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
