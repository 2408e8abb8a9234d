// Benchmarks of frames: the renderer and minimal OpenGL that draws the same, in turn.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>

#include "app/context/headless_context.h"
#include "app/session/session.h"
#include "renderer/render/renderer.h"
#include "renderer/scenes/builtin.h"
#include "renderer/settings/param.h"
#include "renderer/view/fits/light_fit.h"
#include "tests/bench/bare.h"
#include "tests/bench/load_bench.h"
#include "tests/bench/rotation.h"
#include "tests/bench/rounds.h"
#include "tests/support/agreed_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

constexpr int kWidth = 1280, kHeight = 720;

bool is_file(const std::string& name) {
    return name.ends_with(".glb") || name.ends_with(".gltf");
}
std::filesystem::path shared_file(const std::string& name) {
    return std::filesystem::path(SI_SOURCE_DIR) / "../shared" / name;
}

/// Returns an error text for a missing scene; no proxy scene replaces it.
std::string missing_file(const std::string& name) {
    return !is_file(name) || std::filesystem::exists(shared_file(name)) ? "" : "../shared/" + name + " is missing";
}

/// Removes normal maps and blending, which the minimal program does not draw. No downloaded model needs more.
Scene plainly_textured(Scene scene) {
    for (Material& m : scene.materials) {
        m.normal_texture = -1;
        m.unlit = false;
        if (m.alpha == AlphaMode::Blend) m.alpha = AlphaMode::Opaque;
    }
    return scene;
}

/// Loads "100k" or "1M" (agreed scenes), a file of ../shared, or a built-in scene.
Scene bench_scene(const std::string& name) {
    if (name == "100k") return test::agreed_scene(test::AgreedSize::Triangles100k);
    if (name == "1M") return test::agreed_scene(test::AgreedSize::Triangles1M);
    if (is_file(name)) return plainly_textured(load_scene(shared_file(name).string()));
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

/// Sets a fit over the whole scene, a plain sky and no tone curve: the minimal program has no others.
Settings around_the_scene() {
    return settings_with({}, {"light.fit=scene", "shading.sky=plain", "shading.curve=plain"});
}

/// A kernel of the renderer with the BareForward configuration that matches it.
struct Row {
    const char* name;
    const char* kernel;
    BareKernel bare;
    int size;
};
constexpr Row kRows[] = {{"none", "hard", BareKernel::None, 1},     {"hard", "hard", BareKernel::Nearest, 1},
                         {"hw2x2", "hw2x2", BareKernel::Gather, 1}, {"pcf3", "pcf3", BareKernel::Gather, 3},
                         {"pcf5", "pcf5", BareKernel::Gather, 5},   {"pcf7", "pcf7", BareKernel::Gather, 7},
                         {"vsm", "vsm", BareKernel::Vsm, 1},        {"pcss", "pcss", BareKernel::Pcss, 1}};
/// Baseline of the ratios named _of_sampler: the plain way, 3 x 3 filtered taps.
constexpr BareOptions kSampler{
    .kernel = BareKernel::Sampler, .size = 3, .light = BareLight::Lambert, .large_last = false};

/// One scene, kernel and resolution for the renderer and the minimal programs.
struct Match {
    Machine& machine;
    Settings settings;
    FrameRequest request{.width = kWidth, .height = kHeight};
    FrameResult facts;  ///< result of one frame of the renderer
    FittedLight light;  ///< fitted light of a frame in which it casts
    int resolution;

    Match(Machine& m, Settings base, const Row& row, int map_resolution)
        : machine(m), settings(std::move(base)), resolution(map_resolution) {
        set_setting(settings, "filter.kernel", row.kernel);
        set_setting(settings, "map.resolution", std::to_string(map_resolution));
        light = fit_lights(m.scene, settings)[0];
        settings.lights[0].cast = row.bare != BareKernel::None;
        request.force = true;
        facts = m.renderer.render(m.scene, settings, request);
    }
    BareForward bare(const BareOptions& options) const {
        return BareForward(machine.scene, options, resolution, kWidth, kHeight);
    }
    void draw(BareForward& bare) const { bare.draw(facts.camera, light); }
    void draw_ours() const { machine.renderer.render(machine.scene, settings, request); }
};

/// Times the renderer, the cheapest minimal program ("floor"), the minimal program with the same light ("like";
/// `separate`: in the same passes) and bare PCF 3 x 3 with a shadow sampler.
void whole_frame(benchmark::State& state, const char* file, const Row& row, int resolution, bool separate,
                 Settings s = around_the_scene()) {
    s.shading.separate_visibility = separate;
    const Match match(Machine::get(file), s, row, resolution);
    BareForward sampler = match.bare(kSampler);
    BareForward floor = match.bare({.kernel = row.bare, .size = row.size, .light = BareLight::Lambert});
    BareForward like = match.bare({.kernel = row.bare, .size = row.size, .separate_visibility = separate});
    Rotation rotation;
    rotation.add_draw("ours", [&] { match.draw_ours(); });
    rotation.add_draw("like", [&] { match.draw(like); });
    rotation.add_draw("floor", [&] { match.draw(floor); });
    rotation.add_draw("sampler", [&] { match.draw(sampler); });
    rotation.run(state);
    rotation.ratio(state, "ratio", "ours", "like");
    for (const char* who : {"ours", "like", "floor"})
        rotation.ratio(state, std::string(who) + "_of_sampler", who, "sampler");
}

/// Times frames with sky, ambient sky light and filmic curve, and without.
void look(benchmark::State& state, const char* file, const Row& row) {
    Match match(Machine::get(file), around_the_scene(), row, 2048);
    Rotation rotation;
    for (const bool on : {true, false})
        rotation.add_draw(on ? "look" : "plain", [&match, on] {
            match.settings.shading.sky = on ? SkyLook::Gradient : SkyLook::Plain;
            match.settings.shading.curve = on ? ToneCurve::Filmic : ToneCurve::Plain;
            match.draw_ours();
        });
    rotation.run(state);
    rotation.ratio(state, "look_of_plain", "look", "plain");
}

/// Times numbers read from images and from uniform blocks for the same picture.
void blocks_as_images(benchmark::State& state, const char* file, const Row& row) {
    Match match(Machine::get(file), around_the_scene(), row, 2048);
    Rotation rotation;
    for (const bool images : {true, false})
        rotation.add_draw(images ? "images" : "blocks", [&match, images] {
            match.request.blocks_as_images = images;
            match.draw_ours();
        });
    rotation.run(state);
    rotation.ratio(state, "ratio", "images", "blocks");
}

/// Times pictures alone while the camera moves and the map is cached, for the renderer and the minimal programs.
void moving_camera(benchmark::State& state, const Row& row) {
    Settings s = around_the_scene();
    s.camera = {.source = CameraSource::Manual, .target_y = 0.5, .azimuth = 42, .elevation = 23.8, .distance = 31};
    const Match match(Machine::get("100k"), s, row, 2048);
    BareForward floor = match.bare({.kernel = row.bare, .size = row.size, .light = BareLight::Lambert});
    BareForward like = match.bare({.kernel = row.bare, .size = row.size});
    match.draw(floor);
    match.draw(like);
    Settings moved = match.settings;
    moved.camera.fov += 1e-3;
    const FrameRequest kept{.width = kWidth, .height = kHeight};
    int frames = 0;
    Rotation rotation;
    rotation.add_draw("ours", [&] {
        const Settings& shown = ++frames % 2 ? moved : match.settings;
        match.machine.renderer.render(match.machine.scene, shown, kept);
    });
    rotation.add_draw("like", [&] { like.draw(match.facts.camera, match.light, false); });
    rotation.add_draw("floor", [&] { floor.draw(match.facts.camera, match.light, false); });
    rotation.run(state);
    rotation.ratio(state, "ratio", "ours", "like");
    rotation.ratio(state, "like_of_floor", "like", "floor");
}

/// Returns the mean |A - B| of the channels, 0 ... 1, of the minimal program's and the renderer's pictures.
double picture_difference(const BareForward& bare, const ByteImage& ours) {
    const std::vector<std::uint8_t> a = bare.picture();
    const std::size_t row = std::size_t(ours.width) * 4;
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(int(a[i]) - int(ours.data[(std::size_t(ours.height) - 1 - i / row) * row + i % row]));
    return sum / double(a.size()) / 255;
}

/// Applies the scene's suggestions with the brightness of the minimal program.
Settings textured_settings(const Scene& scene) {
    Settings s = around_the_scene();
    for (const auto& [key, value] : scene.suggested) set_setting(s, key, value);
    s.lights[0].intensity = LightSettings{}.intensity;
    s.shading.ambient = Settings{}.shading.ambient;
    return s;
}

/// Times a scene with textures and masks: the minimal program that draws them ("like"; `separate`: in the same passes)
/// and one that draws neither ("plain"); also fused, and the depth pass alone.
void textured_frame(benchmark::State& state, const std::string& name, const Row& row, int resolution, bool separate) {
    if (const std::string why = missing_file(name); !why.empty()) return state.SkipWithError(why.c_str());
    Machine& m = Machine::get(name);
    Settings s = textured_settings(m.scene);
    s.shading.separate_visibility = separate;
    const Match match(m, s, row, resolution);
    const BareOptions options{
        .kernel = row.bare, .size = row.size, .cull_casters = false, .separate_visibility = separate};
    BareOptions textured = options;
    textured.materials = BareMaterials::Textures;
    BareForward like = match.bare(textured), plain = match.bare(options);
    match.draw(like);
    const double difference = picture_difference(like, m.renderer.read_colour(match.facts.colour));
    state.counters["picture_difference"] = difference;
    // Biases differ, and so do shadow edges.
    if (difference > 0.02) return state.SkipWithError("the bare program draws another picture");
    FrameRequest map = match.request;
    map.outputs = {.colour = false, .shadow_map = true};
    map.timing = true;
    // The minimal program draws all moments in its depth pass, the renderer in separate passes.
    const bool times_map = row.bare != BareKernel::None && row.bare != BareKernel::Vsm && !separate;
    Rotation rotation;
    rotation.add_draw("ours", [&] { match.draw_ours(); });
    rotation.add_draw("like", [&] { match.draw(like); });
    rotation.add_draw("plain", [&] { match.draw(plain); });
    if (times_map) {
        rotation.add_draw("depth_like", [&] { like.draw(match.facts.camera, match.light, true, false); });
        rotation.add("depth_ours", [&] { return m.renderer.render(m.scene, match.settings, map).passes[0].gpu_ms; });
    }
    rotation.run(state);
    rotation.ratio(state, "ratio", "ours", "like");
    rotation.ratio(state, "plain_ratio", "ours", "plain");
    if (times_map) rotation.ratio(state, "depth_ratio", "depth_ours", "depth_like");
}

/// Times the shadow map alone: the minimal program with culled back faces ("culled") or without, and the renderer with
/// a fragment shader for all casters ("looked_at").
void depth_pass(benchmark::State& state, const char* file) {
    const Match match(Machine::get(file), around_the_scene(), kRows[2], 2048);
    BareForward culled = match.bare({}), whole = match.bare({.cull_casters = false});
    FrameRequest map = match.request;
    map.outputs = {.colour = false, .unfiltered_map = true};  // maps alone
    FrameRequest forced = map;
    forced.forced = {Optimisation::CasterFragments};
    Renderer& renderer = match.machine.renderer;
    Rotation rotation;
    rotation.add_draw("ours", [&] { renderer.render(match.machine.scene, match.settings, map); });
    rotation.add_draw("looked_at", [&] { renderer.render(match.machine.scene, match.settings, forced); });
    rotation.add_draw("culled", [&] { culled.draw(match.facts.camera, match.light, true, false); });
    rotation.add_draw("whole", [&] { whole.draw(match.facts.camera, match.light, true, false); });
    rotation.run(state);
    rotation.ratio(state, "ratio", "ours", "culled");
    rotation.ratio(state, "whole_ratio", "ours", "whole");
    rotation.ratio(state, "looked_at_ratio", "looked_at", "culled");
    const FrameResult drawn = renderer.render(match.machine.scene, match.settings, map);
    for (const PassInfo& pass : drawn.passes)
        for (const PartInfo& part : pass.parts)
            if (part.by == Optimisation::CasterFragments) state.counters["not_looked_at"] += double(part.left_out);
}

/// Times the shadow sampler and gathers with own comparison, for the same kernel and picture.
void gather_against_sampler(benchmark::State& state, const char* kernel) {
    Machine& m = Machine::get("100k");
    Settings sampler = around_the_scene(), gather;
    set_setting(sampler, "filter.kernel", kernel);
    gather = sampler;
    set_setting(sampler, "filter.method", "sampler");
    set_setting(gather, "filter.method", "gather");
    FrameRequest request{.width = kWidth, .height = kHeight};
    request.force = true;
    Rotation rotation;
    rotation.add_draw("gather", [&] { m.renderer.render(m.scene, gather, request); });
    rotation.add_draw("sampler", [&] { m.renderer.render(m.scene, sampler, request); });
    rotation.run(state);
    rotation.ratio(state, "ratio", "gather", "sampler");
}

void unchanged_frame(benchmark::State& state, const std::string& name) {
    if (const std::string why = missing_file(name); !why.empty()) return state.SkipWithError(why.c_str());
    Machine& m = Machine::get(name);
    const Settings s = textured_settings(m.scene);
    FrameRequest forced{.width = kWidth, .height = kHeight}, cached = forced;
    forced.force = true;
    Rotation rotation;
    rotation.add_draw("cached", [&] { m.renderer.render(m.scene, s, cached); });
    rotation.add_draw("forced", [&] { m.renderer.render(m.scene, s, forced); });
    rotation.run(state);
    rotation.ratio(state, "ratio", "cached", "forced");
}

/// Loads the agreed scene from ../shared, which other programs draw too.
void shared_scene(benchmark::State& state, const Row& row) {
    const std::string name = "perf/scene100k.glb";
    if (const std::string why = missing_file(name); !why.empty()) return state.SkipWithError(why.c_str());
    whole_frame(state, name.c_str(), row, 2048, false, textured_settings(Machine::get(name).scene));
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

constexpr int kRounds = 30;  ///< rounds of a benchmark, unless SI_BENCH_ROUNDS is set

/// Scenes of textured benchmarks. The stage is built in. Downloaded are the flowers (7,636 triangles of masked leaves
/// in vases of 6,400) and the graveyard (84,413 textured triangles in 637 nodes). The forest is 10,000 trees of masked
/// leaves.
void register_textured(const auto& add) {
    for (const auto& [scene, path] : {std::pair{"stage", "stage"},
                                      {"flowers", "models/khr_GlassVaseFlowers/glTF/GlassVaseFlowers.gltf"},
                                      {"graveyard", "models/kaykit_graveyard/kaykit_graveyard.glb"}}) {
        for (const Row& row : kRows) {
            add(fmt::format("textured/{}/{}/2048", scene, row.name),
                [row, file = path](benchmark::State& s) { textured_frame(s, file, row, 2048, false); });
            if (row.bare != BareKernel::None)
                add(fmt::format("textured_separate/{}/{}/2048", scene, row.name),
                    [row, file = path](benchmark::State& s) { textured_frame(s, file, row, 2048, true); });
        }
        add(fmt::format("textured_unchanged/{}", scene),
            [file = path](benchmark::State& s) { unchanged_frame(s, file); });
    }
    for (const Row& row : {kRows[0], kRows[1], kRows[3]})
        add(fmt::format("textured/forest/{}/2048", row.name), [row](benchmark::State& s) {
            textured_frame(s, "models/gen_forest_10k/forest_10k.glb", row, 2048, false);
        });
}

void register_all() {
    const auto add = [](std::string name, auto function) {
        benchmark::RegisterBenchmark(name.c_str(), function)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(bench_rounds(kRounds));
    };
    for (const Row& row : kRows) {
        for (const int resolution : {1024, 2048, 4096})
            add(fmt::format("fused/{}/{}", row.name, resolution),
                [row, resolution](benchmark::State& s) { whole_frame(s, "100k", row, resolution, false); });
        add(fmt::format("fused_1M/{}/2048", row.name),
            [row](benchmark::State& s) { whole_frame(s, "1M", row, 2048, false); });
        if (row.bare != BareKernel::None)
            add(fmt::format("separate/{}/2048", row.name),
                [row](benchmark::State& s) { whole_frame(s, "100k", row, 2048, true); });
    }
    for (const Row& row : kRows)
        add(fmt::format("moving_camera/{}/2048", row.name), [row](benchmark::State& s) { moving_camera(s, row); });
    register_textured(add);
    // scripts/beside_bare.sh runs these together with other programs.
    for (const Row& row : {kRows[1], kRows[3], kRows[4]})
        add(fmt::format("shared_scene/{}/2048", row.name), [row](benchmark::State& s) { shared_scene(s, row); });
    for (const Row& row : {kRows[0], kRows[1], kRows[3]}) {
        add(fmt::format("look/{}", row.name), [row](benchmark::State& s) { look(s, "100k", row); });
        add(fmt::format("look_stage/{}", row.name), [row](benchmark::State& s) { look(s, "stage", row); });
        add(fmt::format("blocks_as_images/{}", row.name),
            [row](benchmark::State& s) { blocks_as_images(s, "100k", row); });
    }
    add("depth_pass/100k", [](benchmark::State& s) { depth_pass(s, "100k"); });
    add("depth_pass/1M", [](benchmark::State& s) { depth_pass(s, "1M"); });
    for (const char* kernel : {"hw2x2", "pcf3", "pcf5", "pcf7"})
        add(fmt::format("gather_against_sampler/{}", kernel),
            [kernel](benchmark::State& s) { gather_against_sampler(s, kernel); });
    add("unchanged_frame", [](benchmark::State& s) { unchanged_frame(s, "100k"); });
    add("first_frame/landscape", [](benchmark::State& s) { first_frame_of_a_scene(s, "landscape"); });
    register_load_benchmarks(bench_rounds(kRounds));
    register_lookup_benchmarks(bench_rounds(kRounds));
}

}  // namespace

void register_frame_benchmarks() {
    register_all();
}

}  // namespace si
