// Benchmarks of growth: times over triangles, lights, objects, cascades, taps and texels. `slope` is the exponent of
// the power law through the last half of the points, where fixed costs matter least. `expected` is the exponent of the
// work. Points above a minute or several gigabytes run only with SI_BENCH_LONG.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "app/context/headless_context.h"
#include "renderer/inspect/probe.h"
#include "renderer/reference/reference_task.h"
#include "renderer/render/reference_frames.h"
#include "renderer/render/renderer.h"
#include "renderer/scenes/builtin.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "tests/bench/curves.h"
#include "tests/bench/rounds.h"
#include "tests/support/agreed_scene.h"

namespace si {

double power_law(std::span<const double> x, std::span<const double> y) {
    const double n = double(x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = std::log(x[i]), v = std::log(y[i]);
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    return x.size() < 2 ? std::numeric_limits<double>::quiet_NaN() : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

namespace {

constexpr double kMinMs = 0.05;  ///< shorter times measure clocks and keys instead of growth
const FrameRequest kCurveFrame{.width = 640, .height = 360};

/// Makes a wavy ground of about so many triangles.
Scene wavy_ground(double triangles) {
    const int cells = std::max(1, int(std::lround(std::sqrt(triangles / 2))));
    Mesh mesh = make_plane(20, 20, cells, cells);
    mesh.uv.clear();
    for (glm::vec3& p : mesh.positions.edit()) p.y = float(0.5 * std::sin(2.1 * p.x) * std::cos(1.7 * p.z));
    mesh.normals.clear();
    Scene scene;
    add_object(scene, "Ground", -1,
               add_mesh(scene, "Ground", std::move(mesh), add_material(scene, "grey", {0.6f, 0.6f, 0.6f})));
    return scene;
}

/// Makes boxes on nodes of their own in a square whose size does not depend on their number.
Scene many_boxes(double objects) {
    Scene scene;
    scene.name = fmt::format("{} boxes", objects);
    const int across = int(std::ceil(std::sqrt(objects)));
    const double cell = 20.0 / across;
    const int mesh =
        add_mesh(scene, "Box", make_box(glm::dvec3(0.6 * cell)), add_material(scene, "grey", {0.6f, 0.6f, 0.6f}));
    for (int i = 0; i < int(objects); ++i) {
        Object o;
        o.node = add_node(scene, fmt::format("Box {}", i));
        o.mesh = mesh;
        o.instance = moved(i % across * cell, 0, i / across * cell);
        scene.objects.push_back(o);
    }
    return scene;
}

Scene agreed(double) {
    return test::agreed_scene(test::AgreedSize::Triangles100k);
}

void set_lights(Settings& s, double count) {
    s.light_count = int(count);
    for (int i = 0; i < int(count); ++i) {
        s.lights[std::size_t(i)].azimuth = 360.0 * i / count;
        s.lights[std::size_t(i)].elevation = 55;
        s.lights[std::size_t(i)].intensity = 1 / count;
    }
    set_setting(s, "map.resolution", "1024");
}

void set_taps(Settings& s, double taps) {
    set_setting(s, "filter.kernel", "vogel");
    set_setting(s, "filter.taps", fmt::format("{}", int(taps)));
}

/// A varied size and the times that may grow with it.
struct Axis {
    const char* name;
    std::vector<double> at, at_length;  ///< sizes of an ordinary run; further sizes for SI_BENCH_LONG
    Scene (*scene)(double);             ///< maker of the scene of a size, before finalise()
    void (*set)(Settings&, double);
    double expected;  ///< expected exponent of the work
    bool scene_grows = false;
};

const std::vector<Axis>& axes() {
    static const std::vector<Axis> all = {
        {"triangles", {1e3, 1e4, 1e5, 1e6}, {1e7}, wavy_ground, [](Settings&, double) {}, 1, true},
        {"objects", {1e2, 1e3, 1e4, 1e5}, {}, many_boxes, [](Settings&, double) {}, 1, true},
        {"lights", {1, 2, 4, 8, 16}, {}, agreed, set_lights, 1},
        {"cascades",
         {1, 2, 4, 8},
         {},
         agreed,
         [](Settings& s, double n) { set_setting(s, "light.cascades", fmt::format("{}", int(n))); },
         1},
        {"taps", {4, 8, 16, 32, 64}, {}, agreed, set_taps, 1},
        {"resolution",
         {256, 512, 1024, 2048, 4096, 8192},
         {},
         agreed,
         [](Settings& s, double n) { set_setting(s, "map.resolution", fmt::format("{}", int(n))); },
         2},
    };
    return all;
}

/// Measures one point of a curve with a renderer of its own.
class CurvePoint {
public:
    CurvePoint(const Axis& axis, double x, std::map<std::string, std::vector<double>>& ms) : ms_(ms) {
        scene_ = axis.scene(x);
        if (axis.scene_grows) take("scene finished", [&] { finalise(scene_); });
        settings_.lights[0].elevation = 50;
        axis.set(settings_, x);
        if (!axis.scene_grows) {
            draw({});
            return;
        }
        take("first frame", [&] { draw({}); });
        take("truth, its hierarchy built", [&] { trace(); });
    }

    void round(bool scene_grows) {
        take("frame, all anew", [&] { draw({.forced_frame = true}); });
        take("light turned", [&] {
            settings_.lights[0].azimuth += 1;
            draw({});
        });
        if (!scene_grows) return;
        take("nothing changed", [&] { draw({}); });
        take("node moved", [&] {
            scene_.nodes.back().local[3].y += 0.01;
            refresh(scene_);
            draw({});
        });
        take("object not casting", [&] {
            ObjectSettings& own = settings_.objects[scene_.nodes.back().path];
            own.cast = !own.cast;
            draw({});
        });
        take("pixel probed",
             [&] { renderer_.probe(scene_, settings_, kCurveFrame, kCurveFrame.width / 2, kCurveFrame.height / 2); });
    }

private:
    struct How {
        bool forced_frame = false;
    };
    std::map<std::string, std::vector<double>>& ms_;
    Renderer renderer_;
    Scene scene_;
    Settings settings_;

    void draw(How how) {
        FrameRequest request = kCurveFrame;
        request.force = how.forced_frame;
        renderer_.render(scene_, settings_, request);
        glFinish();
    }
    void trace() {
        ReferenceCache cache;
        cache.trace(reference_task(renderer_, scene_, settings_, kCurveFrame, 0, {.nearest = false}));
    }
    template <typename Work>
    void take(const char* name, Work&& work) {
        ms_[name].push_back(wall_ms(work));
    }
};

bool is_long() {
    return std::getenv("SI_BENCH_LONG") != nullptr;
}

void curve(benchmark::State& state, const Axis& axis) {
    const HeadlessContext context;
    std::vector<double> at = axis.at;
    if (is_long()) at.insert(at.end(), axis.at_length.begin(), axis.at_length.end());
    using Times = std::map<std::string, std::vector<double>>;
    {
        Times unused;  // programs
        CurvePoint first(axis, at.front(), unused);
        first.round(axis.scene_grows);
        first.round(axis.scene_grows);
    }
    std::vector<Times> times(at.size());
    std::vector<std::unique_ptr<CurvePoint>> points;
    for (std::size_t i = 0; i < at.size(); ++i) points.push_back(std::make_unique<CurvePoint>(axis, at[i], times[i]));
    for (auto& p : points) {
        Times unused;
        p->round(axis.scene_grows);
    }
    for (auto _ : state)
        for (auto& p : points) state.SetIterationTime(wall_ms([&] { p->round(axis.scene_grows); }) / 1000);
    double steepest = 0;
    for (const auto& [name, first] : times.front()) {
        std::vector<double> ms;
        for (std::size_t i = 0; i < at.size(); ++i) {
            ms.push_back(std::max(median(times[i][name]), kMinMs));
            state.counters[fmt::format("{}@{:g}", name, at[i])] = ms.back();
        }
        const std::size_t half = at.size() / 2;
        const double slope = power_law(std::span(at).subspan(half - (at.size() - half < 2)),
                                       std::span(std::as_const(ms)).subspan(half - (at.size() - half < 2)));
        state.counters[name + ", slope"] = slope;
        steepest = std::max(steepest, slope);
    }
    state.counters["steepest"] = steepest;
    state.counters["expected"] = axis.expected;
}

const bool registered = [] {
    for (const Axis& axis : axes())
        benchmark::RegisterBenchmark(fmt::format("curve/{}", axis.name).c_str(),
                                     [&axis](benchmark::State& s) { curve(s, axis); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(bench_rounds(5));
    return true;
}();

}  // namespace
}  // namespace si
