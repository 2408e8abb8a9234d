// The renderer against the least OpenGL that draws the same, frame by frame in turn, so that drift of the machine falls
// on both alike. Read the ratio; the milliseconds hold for this machine and minute only.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>

#include "app/context/headless_context.h"
#include "app/session/session.h"
#include "renderer/frame/renderer.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "tests/bench/bare.h"
#include "tests/bench/load_bench.h"
#include "tests/bench/median.h"
#include "tests/support/agreed_scene.h"

namespace si {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kWidth = 1280, kHeight = 720;

/// Nothing stands in for a scene that is missing.
std::string missing_file(const std::string& name) {
    const auto path = std::filesystem::path(SI_SOURCE_DIR) / "../shared" / name;
    return !name.ends_with(".glb") || std::filesystem::exists(path) ? "" : "../shared/" + name + " is missing";
}

/// "100k" or "1M": the agreed scenes; a file of ../shared; a built-in scene.
Scene bench_scene(const std::string& name) {
    if (name == "100k") return test::agreed_scene(test::AgreedSize::Triangles100k);
    if (name == "1M") return test::agreed_scene(test::AgreedSize::Triangles1M);
    if (name.ends_with(".glb")) return load_scene((std::filesystem::path(SI_SOURCE_DIR) / "../shared" / name).string());
    return load_scene(name);
}

struct Machine {
    HeadlessContext context;
    Renderer renderer;
    Scene scene;
    explicit Machine(const std::string& name) : scene(bench_scene(name)) {}
    static Machine& get(const std::string& name) {
        static std::map<std::string, std::unique_ptr<Machine>> machines;
        auto& m = machines[name];
        if (!m) m = std::make_unique<Machine>(name);
        m->context.make_current();
        return *m;
    }
};

template <typename F>
double finished_ms(F&& draw) {
    glFinish();
    const auto start = Clock::now();
    draw();
    glFinish();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Alternates two ways of drawing, with `between` after both; the benchmark's own time is the second's.
template <typename A, typename B, typename C>
void pair(benchmark::State& state, A&& bare, B&& ours, C&& between) {
    for (int i = 0; i < 3; ++i) bare(), ours();  // first use compiles
    std::vector<double> bare_ms, ours_ms;
    for (auto _ : state) {
        bare_ms.push_back(finished_ms(bare));
        ours_ms.push_back(finished_ms(ours));
        state.SetIterationTime(ours_ms.back() / 1000);
        between();
    }
    std::vector<double> ratios;
    for (std::size_t i = 0; i < bare_ms.size(); ++i) ratios.push_back(ours_ms[i] / bare_ms[i]);
    std::sort(ratios.begin(), ratios.end());
    state.counters["bare_ms"] = median(bare_ms);
    state.counters["ours_ms"] = median(ours_ms);
    state.counters["ratio"] = median(ratios);
    state.counters["ratio_p25"] = ratios[ratios.size() / 4];
    state.counters["ratio_p75"] = ratios[ratios.size() * 3 / 4];
}

template <typename A, typename B>
void pair(benchmark::State& state, A&& bare, B&& ours) {
    pair(state, bare, ours, [] {});
}

/// The bare program knows of no map that holds less than the scene.
Settings around_the_scene() {
    Settings s;
    s.lights[0].fit = int(LightFit::Scene);
    return s;
}

/// A kernel of the renderer, and what BareForward calls it.
struct Row {
    const char* kernel;
    int size;
};
constexpr Row kRows[] = {{"none", 0}, {"hard", -1}, {"hw2x2", 1}, {"pcf3", 3}, {"pcf5", 5}, {"pcf7", 7}};

void whole_frame(benchmark::State& state, const char* file, const char* kernel, int size, int resolution,
                 bool separate) {
    Machine& m = Machine::get(file);
    Settings s = around_the_scene();
    set_setting(s, "filter.kernel", kernel == std::string("none") ? "hard" : kernel);
    set_setting(s, "map.resolution", std::to_string(resolution));
    if (size == 0) s.lights[0].cast = false;
    s.shading.separate_visibility = separate;
    FrameRequest request{.width = kWidth, .height = kHeight};
    request.force = true;
    const FrameResult facts = m.renderer.render(m.scene, s, request);
    Settings casting = s;
    casting.lights[0].cast = true;
    const FittedLight light = fit_lights(m.scene, casting)[0];
    BareForward bare(m.scene, size, resolution, kWidth, kHeight);
    pair(
        state, [&] { bare.draw(facts.camera, light); }, [&] { m.renderer.render(m.scene, s, request); });
}

/// Mean |A - B| of the channels, 0..1, of the bare program's picture and the renderer's.
double picture_difference(const BareForward& bare, const ByteImage& ours) {
    const std::vector<std::uint8_t> a = bare.picture();
    const std::size_t row = std::size_t(ours.width) * 4;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(int(a[i]) - int(ours.data[(std::size_t(ours.height) - 1 - i / row) * row + i % row]));
    return sum / double(a.size()) / 255;
}

/// A scene with textures and masks against the bare program that draws them (bare_ms, ratio) and the one that draws
/// neither (plain_ms, plain_ratio), in turn; the depth pass by itself likewise (depth_ratio).
void textured_frame(benchmark::State& state, const std::string& name, const Row& row, int resolution) {
    if (const std::string why = missing_file(name); !why.empty()) return state.SkipWithError(why.c_str());
    Machine& m = Machine::get(name);
    Settings s = around_the_scene();
    apply_suggested(m.scene, s);
    set_setting(s, "filter.kernel", row.size == 0 ? "hard" : row.kernel);
    set_setting(s, "map.resolution", std::to_string(resolution));
    s.lights[0].cast = row.size != 0;
    FrameRequest request{.width = kWidth, .height = kHeight};
    request.force = true;
    const FrameResult facts = m.renderer.render(m.scene, s, request);
    Settings casting = s;
    casting.lights[0].cast = true;
    const FittedLight light = fit_lights(m.scene, casting)[0];
    BareForward bare(m.scene, row.size, resolution, kWidth, kHeight, BareMaterials::Textures);
    BareForward plain(m.scene, row.size, resolution, kWidth, kHeight);
    bare.draw(facts.camera, light);
    const double difference = picture_difference(bare, m.renderer.read_colour(facts.colour));
    state.counters["picture_difference"] = difference;
    // Biases differ, and so do the edges of shadows.
    if (difference > 0.02) return state.SkipWithError("the bare program draws another picture");
    const auto draw_plain = [&] { plain.draw(facts.camera, light); };
    for (int i = 0; i < 3; ++i) draw_plain();
    std::vector<double> plain_ms, depth_ms, own_depth_ms;
    FrameRequest map = request;
    map.outputs = {.colour = false, .shadow_map = true};
    map.timing = true;
    m.renderer.render(m.scene, s, map);
    pair(
        state, [&] { bare.draw(facts.camera, light); }, [&] { m.renderer.render(m.scene, s, request); },
        [&] {
            plain_ms.push_back(finished_ms(draw_plain));
            if (row.size == 0) return;
            depth_ms.push_back(finished_ms([&] { bare.draw(facts.camera, light, true, false); }));
            own_depth_ms.push_back(m.renderer.render(m.scene, s, map).passes[0].gpu_ms);
        });
    state.counters["plain_ms"] = median(plain_ms);
    state.counters["plain_ratio"] = state.counters["ours_ms"] / median(plain_ms);
    if (row.size == 0) return;
    state.counters["depth_bare_ms"] = median(depth_ms);
    state.counters["depth_ratio"] = median(own_depth_ms) / median(depth_ms);
}

void depth_pass(benchmark::State& state, const char* file) {
    Machine& m = Machine::get(file);
    const Settings s = around_the_scene();
    FrameRequest request{.width = kWidth, .height = kHeight};
    request.outputs = {.colour = false, .shadow_map = true};
    request.force = true;
    request.timing = true;
    const FrameResult facts = m.renderer.render(m.scene, s, request);
    BareForward bare(m.scene, 1, 2048, kWidth, kHeight);
    std::vector<double> bare_ms, ratios;
    for (auto _ : state) {
        bare_ms.push_back(finished_ms([&] { bare.draw(facts.camera, facts.lights[0], true, false); }));
        const double ours = m.renderer.render(m.scene, s, request).passes[0].gpu_ms;
        ratios.push_back(ours / bare_ms.back());
        state.SetIterationTime(ours / 1000);
    }
    state.counters["bare_ms"] = median(bare_ms);
    state.counters["ratio"] = median(ratios);
}

/// The shadow sampler (bare_ms) against gathers with own comparison (ours_ms), the same kernel and picture.
void gather_against_sampler(benchmark::State& state, const char* kernel) {
    Machine& m = Machine::get("100k");
    Settings sampler = around_the_scene(), gather;
    set_setting(sampler, "filter.kernel", kernel);
    gather = sampler;
    set_setting(sampler, "filter.method", "sampler");
    set_setting(gather, "filter.method", "gather");
    FrameRequest request{.width = kWidth, .height = kHeight};
    request.force = true;
    pair(
        state, [&] { m.renderer.render(m.scene, sampler, request); },
        [&] { m.renderer.render(m.scene, gather, request); });
}

void unchanged_frame(benchmark::State& state) {
    Machine& m = Machine::get("100k");
    const Settings s = around_the_scene();
    FrameRequest forced{.width = kWidth, .height = kHeight}, cached = forced;
    forced.force = true;
    pair(
        state, [&] { m.renderer.render(m.scene, s, forced); }, [&] { m.renderer.render(m.scene, s, cached); });
}

void first_frame_of_a_scene(benchmark::State& state, const char* name) {
    for (auto _ : state) {
        HeadlessContext context;
        Renderer renderer;
        const Scene scene = load_scene(name);
        state.SetIterationTime(
            finished_ms([&] { renderer.render(scene, Settings{}, {.width = kWidth, .height = kHeight}); }) / 1000);
    }
}

/// Rounds per benchmark: SI_BENCH_ROUNDS, 30 unless told.
int rounds() {
    const char* text = std::getenv("SI_BENCH_ROUNDS");
    return text ? std::clamp(std::atoi(text), 1, 10000) : 30;
}

void register_all() {
    const auto add = [](std::string name, auto function) {
        benchmark::RegisterBenchmark(name.c_str(), function)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(rounds());
    };
    for (const Row& row : kRows) {
        for (const int resolution : {1024, 2048, 4096})
            add(fmt::format("fused/{}/{}", row.kernel, resolution), [row, resolution](benchmark::State& s) {
                whole_frame(s, "100k", row.kernel, row.size, resolution, false);
            });
        add(fmt::format("fused_1M/{}/2048", row.kernel),
            [row](benchmark::State& s) { whole_frame(s, "1M", row.kernel, row.size, 2048, false); });
    }
    // The stage is always there; the forest is 10,000 trees of masked leaves.
    for (const auto& [scene, file] : {std::pair{"stage", "stage"}, {"forest", "models/gen_forest_10k/forest_10k.glb"}})
        for (const Row& row : {kRows[0], kRows[1], kRows[3]})
            add(fmt::format("textured/{}/{}/2048", scene, row.kernel),
                [row, file](benchmark::State& s) { textured_frame(s, file, row, 2048); });
    add("separate/pcf3/2048", [](benchmark::State& s) { whole_frame(s, "100k", "pcf3", 3, 2048, true); });
    add("depth_pass/100k", [](benchmark::State& s) { depth_pass(s, "100k"); });
    add("depth_pass/1M", [](benchmark::State& s) { depth_pass(s, "1M"); });
    for (const char* kernel : {"hw2x2", "pcf3", "pcf5", "pcf7"})
        add(fmt::format("gather_against_sampler/{}", kernel),
            [kernel](benchmark::State& s) { gather_against_sampler(s, kernel); });
    add("unchanged_frame", unchanged_frame);
    add("first_frame/landscape", [](benchmark::State& s) { first_frame_of_a_scene(s, "landscape"); });
    register_load_benchmarks(rounds());
}

}  // namespace

void register_frame_benchmarks() {
    register_all();
}

}  // namespace si
