// Benchmarks of casters: many casters under a turning light compared with minimal OpenGL, and each optimisation
// compared with the same map drawn without it.
#include <benchmark/benchmark.h>

#include <cmath>
#include <optional>

#include "app/context/headless_context.h"
#include "renderer/render/renderer.h"
#include "renderer/scene/clusters.h"
#include "renderer/scenes/shapes.h"
#include "renderer/settings/param.h"
#include "renderer/view/culling/needed_maps.h"
#include "tests/bench/bare.h"
#include "tests/bench/rotation.h"
#include "tests/bench/rounds.h"
#include "tests/support/agreed_scene.h"
#include "tests/support/sets.h"

namespace si {
namespace {

/// Times two ways in turn and reports the ratio of the second to the first with its middle half of the rounds.
template <typename A, typename B>
void time_in_turns(benchmark::State& state, A&& first, B&& second) {
    for (int i = 0; i < 3; ++i) {
        first();
        second();
    }
    std::vector<double> first_ms, ratios;
    for (auto _ : state) {
        first_ms.push_back(finished_ms(first));
        const double ms = finished_ms(second);
        ratios.push_back(ms / first_ms.back());
        state.SetIterationTime(ms / 1000);
    }
    state.counters["first_ms"] = median(first_ms);
    report_ratio(state, std::move(ratios));
}

/// Makes boxes, balls and rings, each on a node of its own, over a floor.
Scene ten_thousand_objects() {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    const int shapes[] = {add_mesh(scene, "Box", make_box(glm::dvec3(0.5)), grey),
                          add_mesh(scene, "Ball", make_sphere(0.3, 12, 8), grey),
                          add_mesh(scene, "Ring", make_torus(0.25, 0.1, 12, 6), grey)};
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(110, 110), grey));
    for (int i = 0; i < 10000; ++i)
        add_object(scene, "Object", -1, shapes[i % 3], moved(i % 100 - 50, 0.4, i / 100 - 50) * turned(i * 7));
    finalise(scene);
    return scene;
}

/// Makes balls of 960 triangles each.
Scene balls_on_a_floor(int count) {
    Scene scene;
    const int grey = add_material(scene, "grey", {0.6f, 0.6f, 0.6f});
    const int ball = add_mesh(scene, "Ball", make_sphere(0.4, 32, 16), grey);
    add_object(scene, "Floor", -1, add_mesh(scene, "Floor", make_plane(10, 10), grey));
    for (int i = 0; i < count; ++i) add_object(scene, "Ball", -1, ball, moved(i % 8 - 3.5, 0.4, i / 8 - 3.5));
    finalise(scene);
    return scene;
}

Settings around_it() {
    Settings s;
    s.lights[0].fit = LightFit::Scene;
    return s;
}

/// Times a frame after the light has turned: the minimal program (first) and the renderer.
void light_turns(benchmark::State& state) {
    HeadlessContext context;
    Renderer renderer;
    const Scene scene = ten_thousand_objects();
    Settings s = around_it();
    FrameResult facts = renderer.render(scene, s, {});
    BareForward bare(scene, BareOptions{}, s.map.resolution, 1280, 720);
    time_in_turns(
        state, [&] { bare.draw(facts.camera, facts.lights[0]); },
        [&] {
            s.lights[0].azimuth += 0.5;
            facts = renderer.render(scene, s, {});
        });
}

/// Times the map of the agreed scene without optimisations (first) and with them.
void agreed_map(benchmark::State& state, const Settings& all) {
    HeadlessContext context;
    Renderer renderer;
    const Scene scene = test::agreed_scene(test::AgreedSize::Triangles100k);
    FrameRequest request{.width = 16, .height = 9, .force = true};
    request.outputs = {.colour = false, .shadow_map = true};
    FrameRequest forced = request;
    forced.forced = {Optimisation::CasterCulling};
    Settings both_sides = all;
    both_sides.bias.raster_units = 1e-30;  // closed meshes keep their back faces under an offset
    time_in_turns(
        state, [&] { renderer.render(scene, both_sides, forced); }, [&] { renderer.render(scene, all, request); });
}

/// Times frames before each of which an azimuth turns: without an optimisation (first) and with it.
void turning_frames(benchmark::State& state, const Scene& scene, const Settings& s, double& azimuth,
                    Optimisation optimisation) {
    HeadlessContext context;
    Renderer renderer;
    FrameRequest request{.width = 160, .height = 90}, whole = request;
    whole.forced = {optimisation};
    const auto draw = [&](const FrameRequest& variant) {
        azimuth += 0.5;
        renderer.render(scene, s, variant);
    };
    time_in_turns(
        state, [&] { draw(whole); }, [&] { draw(request); });
}

/// Times frames of a turning light: maps drawn whole (first) and only where the camera reads them.
void visible_map(benchmark::State& state, const Scene& scene, Settings s) {
    turning_frames(state, scene, s, s.lights[0].azimuth, Optimisation::UnreadViews);
}

/// Times frames of a camera that orbits its target, without shadows: all objects drawn (first) and only objects in the
/// view frustum.
void among_objects(benchmark::State& state, const Scene& scene, Settings s) {
    s.lights[0].cast = false;
    turning_frames(state, scene, s, s.camera.azimuth, Optimisation::FrustumCulling);
}

/// Times the search for read map parts: visible surfaces ("seen_ms", once a camera) and their places in the map
/// ("called_ms").
void analysis(benchmark::State& state, const Scene& scene, const Settings& s) {
    HeadlessContext context;
    Renderer renderer;
    const FrameResult facts = renderer.render(scene, s, {});
    std::vector<std::vector<Cluster>> clusters;
    for (const Mesh& mesh : scene.meshes) clusters.push_back(build_clusters(mesh));
    const auto of_mesh = [&](std::size_t mesh) { return std::span<const Cluster>(clusters[mesh]); };
    const LookupArea area{.resolution = facts.map_resolution, .reach_texels = 3, .normal_texels = 1};
    std::vector<double> seen_ms, called_ms;
    for (auto _ : state) {
        std::optional<VisibleBodies> seen;
        seen_ms.push_back(wall_ms([&] { seen.emplace(find_visible_bodies(scene, facts.camera, 720, of_mesh)); }));
        called_ms.push_back(wall_ms([&] { benchmark::DoNotOptimize(needed_maps(facts.lights[0], *seen, area)); }));
        state.SetIterationTime((seen_ms.back() + called_ms.back()) / 1000);
    }
    state.counters["seen_ms"] = median(seen_ms);
    state.counters["called_ms"] = median(called_ms);
}

/// Times frames in which small boxes move: maps drawn whole (first) and with cached static casters. Scene set-up is not
/// timed.
void moving_boxes(benchmark::State& state, Scene scene, Settings s, int movers) {
    HeadlessContext context;
    Renderer renderer, others;
    const Bounds b = scene.bounds;
    const double size = 0.02 * b.radius();
    const int box = add_mesh(scene, "Mover", make_box(glm::dvec3(size)), -1);
    for (unsigned i = 0; i < 8; ++i) {  // posts, between which the scene's bounds stay
        const glm::dvec3 at =
            b.centre() + 0.55 * (b.hi - b.lo) * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        add_object(scene, "Post", -1, box, moved(at.x, at.y, at.z) * scaled(0.01, 0.01, 0.01));
    }
    const int first = int(scene.nodes.size());
    for (int i = 0; i < movers; ++i) add_object(scene, "Mover", -1, box);
    finalise(scene);
    FrameRequest request{.width = 16, .height = 9}, whole = request, nothing = request;
    request.forced = {Optimisation::UnreadViews};  // the camera sees them whole
    whole.forced = {Optimisation::UnreadViews, Optimisation::StaticCasterCache};
    nothing.outputs.colour = false;
    double turn = 0;
    int kept = 0;
    const auto map_ms = [&](Renderer& by, const FrameRequest& variant) {
        nothing.forced = variant.forced;
        by.render(scene, s, nothing);
        FrameResult frame;
        const double ms = finished_ms([&] { frame = by.render(scene, s, variant); });
        for (const PassInfo& pass : frame.passes)
            for (const PartInfo& part : pass.parts)
                kept += part.by == Optimisation::StaticCasterCache && part.left_out > 0;
        return ms;
    };
    const auto move_on = [&] {
        turn += 0.37;
        for (int i = 0; i < movers; ++i) {
            const double angle = turn + i * 2.4, r = 0.5 * b.radius() * std::sqrt((i + 0.5) / movers);
            scene.nodes[std::size_t(first + i)].local =
                moved(b.centre().x + r * std::cos(angle), b.centre().y, b.centre().z + r * std::sin(angle));
        }
        refresh(scene);
    };
    for (int i = 0; i < 4; ++i) {
        move_on();
        map_ms(others, whole);
        map_ms(renderer, request);
    }
    kept = 0;
    std::vector<double> first_ms, ratios;
    for (auto _ : state) {
        move_on();
        first_ms.push_back(map_ms(others, whole));
        const double ms = map_ms(renderer, request);
        ratios.push_back(ms / first_ms.back());
        state.SetIterationTime(ms / 1000);
    }
    state.counters["first_ms"] = median(first_ms);
    state.counters["kept"] = kept;
    report_ratio(state, std::move(ratios));
}

/// Turns the camera to look from a corner of the scene along one of its sides.
Settings with_partial_view(const Settings& s) {
    return settings_with(s, {"camera.source=manual", "camera.target_x=-40", "camera.target_z=-40", "camera.azimuth=0",
                             "camera.elevation=20", "camera.distance=12"});
}

const int kRegistered = [] {
    Settings directional = around_it(), point, cascades;
    point.lights[0].type = LightType::Point;
    cascades.lights[0].cascades = 4;
    const auto add = [](const char* name, auto run) {
        benchmark::RegisterBenchmark(name, run)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(30);
    };
    add("casters/light_turns/10000_objects", light_turns);
    add("casters/map/directional", [=](benchmark::State& s) { agreed_map(s, directional); });
    add("casters/map/point", [=](benchmark::State& s) { agreed_map(s, point); });
    add("casters/map/cascades_4", [=](benchmark::State& s) { agreed_map(s, cascades); });
    for (const int balls : {1, 4, 16, 64})
        add(("casters/moving_box/" + std::to_string(balls) + "_balls").c_str(),
            [=](benchmark::State& s) { moving_boxes(s, balls_on_a_floor(balls), directional, 1); });
    add("casters/moving_box/1_ball_64_boxes",
        [=](benchmark::State& s) { moving_boxes(s, balls_on_a_floor(1), directional, 64); });
    add("casters/moving_box/1_ball_1000_boxes",
        [=](benchmark::State& s) { moving_boxes(s, balls_on_a_floor(1), directional, 1000); });
    add("casters/moving_box/10000_objects",
        [=](benchmark::State& s) { moving_boxes(s, ten_thousand_objects(), directional, 1); });
    add("casters/moving_box/100k_triangles", [=](benchmark::State& s) {
        moving_boxes(s, test::agreed_scene(test::AgreedSize::Triangles100k), directional, 1);
    });
    add("casters/moving_box/100k_triangles_point",
        [=](benchmark::State& s) { moving_boxes(s, test::agreed_scene(test::AgreedSize::Triangles100k), point, 1); });
    add("casters/analysis/10000_objects",
        [=](benchmark::State& s) { analysis(s, ten_thousand_objects(), directional); });
    add("casters/analysis/100k_triangles",
        [=](benchmark::State& s) { analysis(s, test::agreed_scene(test::AgreedSize::Triangles100k), directional); });
    add("casters/seen/10000_objects_all",
        [=](benchmark::State& s) { visible_map(s, ten_thousand_objects(), directional); });
    add("casters/seen/10000_objects_part",
        [=](benchmark::State& s) { visible_map(s, ten_thousand_objects(), with_partial_view(directional)); });
    add("casters/seen/100k_triangles_all",
        [=](benchmark::State& s) { visible_map(s, test::agreed_scene(test::AgreedSize::Triangles100k), directional); });
    Settings above = with_partial_view(directional);
    above.camera.target_x = above.camera.target_z = 0;
    set_all(above, {"camera.distance=150", "camera.elevation=60"});
    add("casters/in_sight/10000_objects_all",
        [=](benchmark::State& s) { among_objects(s, ten_thousand_objects(), above); });
    add("casters/in_sight/10000_objects_part",
        [=](benchmark::State& s) { among_objects(s, ten_thousand_objects(), with_partial_view(directional)); });
    Settings blurred = with_partial_view(directional);
    blurred.camera.target_x = blurred.camera.target_z = -3;
    set_setting(blurred, "filter.kernel", "vsm");
    add("casters/seen/64_balls_vsm_part", [=](benchmark::State& s) { visible_map(s, balls_on_a_floor(64), blurred); });
    set_all(blurred, {"camera.distance=2.5", "camera.elevation=40"});
    add("casters/seen/64_balls_vsm_close", [=](benchmark::State& s) { visible_map(s, balls_on_a_floor(64), blurred); });
    add("casters/seen/100k_triangles_point",
        [=](benchmark::State& s) { visible_map(s, test::agreed_scene(test::AgreedSize::Triangles100k), point); });
    return 0;
}();

}  // namespace
}  // namespace si
